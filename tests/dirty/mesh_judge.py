"""Says what is wrong with a mesh, from its coordinates alone; standard library only."""
import math
from fractions import Fraction


class Failure(Exception):
    pass


def require(condition, text):
    if not condition:
        raise Failure(text)


def turn_in_plane(a, b, c):
    """Above 0 where a, b, c run counter-clockwise; exact."""
    left, right = (b[0] - a[0]) * (c[1] - a[1]), (c[0] - a[0]) * (b[1] - a[1])
    if abs(left - right) > 1e-14 * (abs(left) + abs(right)) and abs(left) + abs(right) > 1e-280:
        return left - right
    (ax, ay), (bx, by), (cx, cy) = (map(Fraction, p) for p in (a, b, c))
    exact = (bx - ax) * (cy - ay) - (cx - ax) * (by - ay)
    return (exact > 0) - (exact < 0)


def degrees_east(a, b):
    """From one longitude to another the shorter way; rounded once."""
    turns = round((b - a) / 360)
    return math.fsum((b, -a, -360.0 * turns))


def sine_at(a, b, c):
    """The sine of the angle at a from b to c, along great circles. Free of cancellation: on the plane that touches at a."""
    def place(p):
        away = math.radians(degrees_east(a[0], p[0]))
        lat, here, step = math.radians(p[1]), math.radians(a[1]), math.radians(p[1] - a[1])
        x = math.cos(lat) * math.sin(away)
        y = math.sin(step) + 2 * math.sin(here) * math.cos(lat) * math.sin(away / 2) ** 2
        return x, y

    (bx, by), (cx, cy) = place(b), place(c)
    lengths = math.hypot(bx, by) * math.hypot(cx, cy)
    return (bx * cy - cx * by) / lengths if lengths else 0.0


def turn_on_globe(a, b, c):
    """The largest of the three sines, with its sign: above 0 where a, b, c run counter-clockwise, seen from above."""
    return max((sine_at(a, b, c), sine_at(b, c, a), sine_at(c, a, b)), key=abs)


def sides_of(corners, geographic):
    pairs = list(zip(corners, corners[1:] + corners[:1]))
    return [math.hypot(degrees_east(a[0], b[0]) if geographic else b[0] - a[0], b[1] - a[1]) for a, b in pairs]


def is_flat(corners, turned, geographic, chosen, projected, extent):
    """Turned over no further than rounding to the file's coordinates does it, or sides that are straight in the plane that
    the program worked in and not on the ground: in one that the user chose these turn from great circles by about their
    length, in one fitted to the mesh by that times the mesh's extent, all in radians."""
    sides = sides_of(corners, geographic)
    if min(sides) == 0:
        return False  # two nodes at one place
    grain = 8 * max(math.ulp(abs(v)) for p in corners for v in p)
    if not geographic:
        # In a projected CRS, sides that are straight in the program's plane bend by some centimetres over ten
        # kilometres.
        return -turned <= grain * max(sides) + (max(sides) ** 3 / 1e8 if projected else 0)
    return -turned < 4 * grain / min(sides) + math.radians(max(sides)) * (1 if chosen else extent)


def on_sphere(p):
    lon, lat = math.radians(p[0]), math.radians(p[1])
    return [math.degrees(v) for v in (math.cos(lat) * math.cos(lon), math.cos(lat) * math.sin(lon), math.sin(lat))]


def is_named(corners, turned, geographic):
    """Whether a place of the report's section `turned` lies at the triangle; it lists the first 1000."""
    if turned["count"] > len(turned["places"]):
        return True
    place = on_sphere if geographic else list
    points = [place(p) for p in corners]
    size = max(math.dist(p, q) for p in points for q in points) + 1e-12 * max(abs(v) for p in points for v in p)
    named = ((p["lon"], p["lat"]) if "lon" in p else (p["x"], p["y"]) for p in turned["places"])
    return any(math.dist(place(p), points[0]) <= size for p in named)


def check_mesh(nodes, triangles, geographic, reported=None, chosen=False, projected=False):
    """Counter-clockwise triangles, each edge once in each direction, each node used. Those that the report names as turned
    may be flat instead."""
    turn = turn_on_globe if geographic else turn_in_plane
    told = reported["count"] if reported else 0
    extent = math.radians(max(math.dist(on_sphere(nodes[0]), on_sphere(p)) for p in nodes)) if geographic else 0
    edges, used = set(), set()
    for number, t in enumerate(triangles):
        require(len(set(t)) == 3 and all(0 <= n < len(nodes) for n in t), f"triangle {number}: corners {t}")
        corners = [nodes[n] for n in t]
        require(all(math.isfinite(v) for p in corners for v in p), f"triangle {number}: {corners}")
        turned = turn(*corners)
        if turned <= 0:
            told -= 1
            require(told >= 0 and is_named(corners, reported, geographic) and
                    is_flat(corners, turned, geographic, chosen, projected, extent),
                    f"triangle {number} is not counter-clockwise ({turned:.2g}): {corners}")
        used.update(t)
        for edge in zip(t, t[1:] + t[:1]):
            require(edge not in edges, f"edge {edge} runs the same way twice")
            edges.add(edge)
    require(len(used) == len(nodes), f"{len(nodes) - len(used)} nodes without a triangle")


def as_places(nodes, triangles):
    """Triangles by their corners' places, each from its least on; sorted."""
    result = []
    for t in triangles:
        corners = [tuple(nodes[n]) for n in t]
        first = corners.index(min(corners))
        result.append(tuple(corners[first:] + corners[:first]))
    return sorted(result)


def area_in_plane(nodes, triangles):
    """Summed with the origin amid the mesh."""
    x0, y0 = nodes[0]
    return math.fsum(((nodes[b][0] - nodes[a][0]) * (nodes[c][1] - nodes[a][1]) -
                      (nodes[c][0] - nodes[a][0]) * (nodes[b][1] - nodes[a][1])) / 2 for a, b, c in triangles)


def area_of_ring(ring):
    """Signed, in steradians; of a ring in degrees whose edges are great circles, and lines along a pole."""
    total = []
    for (ax, ay), (bx, by) in zip(ring, ring[1:] + ring[:1]):
        width = math.radians(bx - ax)
        if ay == by and abs(ay) == 90.0:
            total.append(-math.copysign(width, ay * width))
            continue
        # The area between the edge and the equator.
        low, high = math.tan(math.radians(ay) / 2), math.tan(math.radians(by) / 2)
        total.append(-2.0 * math.atan2(math.tan(width / 2) * (low + high), 1.0 + low * high))
    return math.fsum(total)


def area_on_globe(a, b, c):
    """Of a triangle smaller than a hemisphere, in steradians, without a map: wherever poles and the longitudes' end are."""
    a, b, c = ([math.radians(v) for v in on_sphere(p)] for p in (a, b, c))
    dot = lambda p, q: math.fsum(v * w for v, w in zip(p, q))
    (u, v, w), (x, y, z) = ([q - p for p, q in zip(a, other)] for other in (b, c))
    volume = math.fsum((a[0] * (v * z - w * y), a[1] * (w * x - u * z), a[2] * (u * y - v * x)))
    return 2.0 * math.atan2(volume, 1.0 + dot(a, b) + dot(b, c) + dot(c, a))


def same_place(p, q, geographic):
    """A file for a model may have a longitude a turn away from that in a layer, which rounds it."""
    return p == q or geographic and p[1] == q[1] and abs(abs(p[0] - q[0]) - 360.0) < 1e-12


def check_layer(layer, nodes, triangles, geographic, what):
    """The layer's polygons are the triangles; one cut at the antimeridian or round a pole by its area."""
    require(len(layer) == len(triangles), f"{what}: {len(layer)} polygons, {len(triangles)} triangles")
    for number, (rings, t) in enumerate(zip(layer, triangles)):
        corners = [tuple(nodes[n]) for n in t]
        if len(rings) == 1 and len(rings[0]) == 3:
            ring = [tuple(p) for p in rings[0]]
            # In a shapefile the orientation marks outer and inner rings; GDAL sets it, with rounding.
            ways = [ring, ring[::-1]] if what.endswith(".shp") else [ring]
            same = any(all(same_place(p, q, geographic) for p, q in zip(way[i:] + way[:i], corners))
                       for way in ways for i in range(3))
            require(same, f"{what}: polygon {number} is {ring}, not {corners}")
            continue
        require(geographic, f"{what}: polygon {number} has {len(rings)} rings")
        require(all(-180 <= x <= 180 and -90 <= y <= 90 for ring in rings for x, y in ring),
                f"{what}: polygon {number} leaves the map: {rings}")
        area, expected = math.fsum(area_of_ring(ring) for ring in rings), area_on_globe(*corners)
        if what.endswith(".shp"):
            area = abs(area)
        require(abs(area - expected) <= 1e-6 * abs(expected) + 1e-15,
                f"{what}: polygon {number} has the area {area:.12g}, not {expected:.12g}: {rings}, {corners}")


def even_odd_union(features):
    """Area of the places that lie in some feature by the even-odd rule over its rings: exact crossings, slab by slab."""
    edges = []
    for number, rings in enumerate(features):
        for ring in rings:
            for a, b in zip(ring, ring[1:] + ring[:1]):
                if a[1] != b[1]:
                    edges.append((min(a, b, key=lambda p: p[1]), max(a, b, key=lambda p: p[1]), number))
    levels = {y for low, high, _ in edges for y in (low[1], high[1])}
    for i, (a, b, _) in enumerate(edges):
        for c, d, _ in edges[:i]:
            if max(a[1], c[1]) >= min(b[1], d[1]):
                continue
            slope, other = (b[0] - a[0]) / (b[1] - a[1]), (d[0] - c[0]) / (d[1] - c[1])
            if slope == other:
                continue
            y = ((c[0] - other * c[1]) - (a[0] - slope * a[1])) / (slope - other)
            if max(a[1], c[1]) < y < min(b[1], d[1]):
                levels.add(y)
    levels, total = sorted(levels), []
    for low, high in zip(levels, levels[1:]):
        middle = low + (high - low) / 2
        met = sorted((a[0] + (middle - a[1]) / (b[1] - a[1]) * (b[0] - a[0]), number) for a, b, number in edges
                     if a[1] <= low and b[1] >= high)
        inside = set()
        for (x, number), (beyond, _) in zip(met, met[1:]):
            inside ^= {number}
            if inside:
                total.append((high - low) * (beyond - x))
    return math.fsum(total)
