"""Draws dirty polygons and options for them; the same number always gives the same."""
import json
import math
import random

UTM = "EPSG:32631"
DEGREE = 111195.0  # metres


def star(rng, x, y, radius, n, rough):
    ring = []
    for i in range(n):
        r = radius * (1 - rough * rng.random())
        angle = 2 * math.pi * (i + 0.5 * rng.random()) / n
        ring.append((x + r * math.cos(angle), y + r * math.sin(angle)))
    return ring


def tangle(rng, n):
    return [(rng.uniform(-1, 1), rng.uniform(-1, 1)) for _ in range(n)]


def on_a_grid(rng, n, cells):
    return [(rng.randint(-cells, cells) / cells, rng.randint(-cells, cells) / cells) for _ in range(n)]


def sliver(rng):
    x, y, angle, width = rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(0, math.pi), 10 ** rng.uniform(-9, -1)
    along = (math.cos(angle), math.sin(angle))
    corners = [(0, 0), (1, 0), (1, width), (rng.random(), 0.5 * width), (0, width)]
    return [(x + s * along[0] - t * along[1], y + s * along[1] + t * along[0]) for s, t in corners]


def any_ring(rng, small=False):
    kind = rng.random()
    size = 0.3 if small else 1.0
    if kind < 0.5:
        x, y = rng.uniform(-0.6, 0.6), rng.uniform(-0.6, 0.6)
        return star(rng, x, y, size * 10 ** rng.uniform(-1, 0), rng.randint(3, 40), rng.choice([0.1, 0.5, 0.99]))
    if kind < 0.65:
        return tangle(rng, rng.randint(3, 12))
    if kind < 0.85:
        return on_a_grid(rng, rng.randint(3, 12), rng.choice([2, 3, 5]))
    return sliver(rng)


def spoil(rng, ring):
    """Repeated and nearly repeated points, spikes, points on edges."""
    spoilt = []
    for i, p in enumerate(ring):
        spoilt.append(p)
        what = rng.random()
        q = ring[(i + 1) % len(ring)]
        if what < 0.05:
            spoilt.append(p)
        elif what < 0.1:
            spoilt.append((p[0] + rng.choice([1e-15, 1e-12, 1e-9, 1e-6]), p[1] - rng.choice([0, 1e-12, 1e-8])))
        elif what < 0.13:
            spoilt += [(p[0] + rng.uniform(-0.2, 0.2), p[1] + rng.uniform(-0.2, 0.2)), p]
        elif what < 0.2:
            share = rng.random()
            spoilt.append((p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1])))
    return spoilt[::-1] if rng.random() < 0.3 else spoilt


def any_features(rng):
    """Lists of rings, in the square of -1 to 1; the even-odd rule says what is inside."""
    features, earlier = [], []
    for _ in range(rng.choice([1, 1, 1, 2, 3, 5])):
        rings = [any_ring(rng)]
        for _ in range(rng.choice([0, 0, 1, 2, 4])):
            if earlier and rng.random() < 0.3:  # almost equal to an earlier ring
                nudge = rng.choice([0, 1e-12, 1e-9, 1e-6, 1e-3])
                rings.append([(x + nudge, y - nudge) for x, y in rng.choice(earlier)])
            else:
                rings.append(any_ring(rng, small=True))
        if rng.random() < 0.6:
            rings = [spoil(rng, ring) for ring in rings]
        earlier += rings
        features.append(rings)
    return features


class World:
    """Where the square of -1 to 1 lies."""

    def __init__(self, rng):
        self.kind = rng.choice(["plane", "utm", "degrees", "degrees", "poly"])
        self.centre, self.half = (0.0, 0.0), 1.0
        self.polar = 0
        if self.kind in ("plane", "poly"):
            self.half = 10 ** rng.uniform(-3, 6)
            if rng.random() < 0.05:
                self.half = 10.0 ** rng.choice([-320, -160, -90, -65, -30, 30, 65, 90, 160, 300])
            if rng.random() < 0.3:
                self.centre = (self.half * rng.uniform(-1e3, 1e3), self.half * rng.uniform(-1e3, 1e3))
            self.metres = self.half
        elif self.kind == "utm":
            self.half = self.metres = 10 ** rng.uniform(0, 5)
            self.centre = (500000 + rng.uniform(-2e5, 2e5), rng.uniform(2e5, 8e6))
        else:
            self.half = 10 ** rng.uniform(-4, 1.2)
            self.metres = self.half * DEGREE
            where = rng.random()
            lat = rng.uniform(-75, 75)
            self.centre = (rng.uniform(-180, 180), lat)
            if where < 0.25:
                self.centre = (rng.choice([180.0, -180.0, 179.999]), lat)
            elif where < 0.4:
                self.polar = rng.choice([-1, 1])
        self.past = rng.random() < 0.3  # longitudes continue beyond 180 degrees
        self.geographic = self.kind == "degrees"

    def place(self, p):
        x, y = p
        if self.polar:
            # Some of the squares contain the pole, some are beside it.
            east, north = x * self.half + (self.centre[0] % 3 - 1) * self.half, y * self.half
            lat = 90 - min(170.0, math.hypot(east, north))
            return (math.degrees(math.atan2(north, east)) * self.polar, lat * self.polar)
        if self.geographic:
            stretch = 1 / max(0.2, math.cos(math.radians(self.centre[1])))
            lon = self.centre[0] + x * self.half * stretch
            if not self.past:
                lon = (lon + 180) % 360 - 180 if not -180 <= lon <= 180 else lon
            return (lon, max(-90.0, min(90.0, self.centre[1] + y * self.half)))
        return (self.centre[0] + x * self.half, self.centre[1] + y * self.half)


class Case:
    """`options` for the command line, files with their text, and what may be judged."""

    def __init__(self, number):
        rng = random.Random(number)
        self.number, self.world = number, World(rng)
        world = self.world
        features = any_features(rng)
        self.files, self.options = {}, []
        self.features = [[[world.place(p) for p in ring] for ring in rings] for rings in features]
        self.keeps_area = True
        if world.kind == "poly":
            self.input = "in.poly"
            self.files[self.input] = self.poly(rng)
        else:
            self.input = "in.geojson"
            polygons = [{"type": "Polygon", "coordinates": [ring + ring[:1] for ring in rings]} for rings in self.features]
            self.files[self.input] = self.layer(polygons)
            self.draw_cleaning(rng)
        self.draw_refinement(rng)

    def layer(self, geometries):
        crs = {} if self.world.geographic else {"crs": {"type": "name", "properties": {"name": UTM}}}
        features = [{"type": "Feature", "id": i, "properties": {"name": f"part {i}"}, "geometry": g}
                    for i, g in enumerate(geometries)]
        return json.dumps({"type": "FeatureCollection", **crs, "features": features})

    def poly(self, rng):
        """One ring, mostly a sound one, with a hole; what is not sound is refused."""
        rings = [star(rng, 0, 0, 1, rng.randint(3, 60), rng.choice([0.1, 0.5]))]
        hollow = rng.random() < 0.5
        if hollow:
            rings.append(star(rng, 0, 0, 0.3, rng.randint(3, 20), 0.5))
        sound = rng.random() >= 0.15
        if not sound:
            rings.append(any_ring(rng))
        rings = [[self.world.place(p) for p in ring] for ring in rings]
        self.features = [rings]
        points, segments = [], []
        for ring in rings:
            first = len(points)
            points += ring
            segments += [(first + i, first + (i + 1) % len(ring)) for i in range(len(ring))]
        lines = [f"{len(points)} 2 0 0"] + [f"{i} {x!r} {y!r}" for i, (x, y) in enumerate(points)]
        lines += [f"{len(segments)} 0"] + [f"{i} {a} {b}" for i, (a, b) in enumerate(segments)]
        hole = self.world.place((0.0, 0.0))
        lines += [f"1\n0 {hole[0]!r} {hole[1]!r}"] if hollow else ["0"]
        self.keeps_area = sound  # the inside of the extra ring is meshed too
        return "\n".join(lines) + "\n"

    def length(self, rng, low, high):
        """In metres, as a share of half the square."""
        return repr(min(1e60, max(1e-60, self.world.metres)) * 10 ** rng.uniform(low, high))

    def draw_cleaning(self, rng):
        world, options = self.world, self.options
        if world.kind == "plane":
            options += ["--crs", "plane"]
        elif rng.random() < 0.15 and world.kind == "utm":
            options += ["--crs", rng.choice(["EPSG:32631", "EPSG:3035", "EPSG:3857"])]
        elif rng.random() < 0.1 and not world.polar:
            options += ["--crs", rng.choice(["EPSG:3857", "EPSG:4326"])]
        if rng.random() < 0.35:
            options += ["--simplify", self.length(rng, -4, 0)]
            self.keeps_area = False
        if rng.random() < 0.25:
            snap = rng.choice(["0", self.length(rng, -7, -2)])
            options += ["--snap", snap]
            self.keeps_area = self.keeps_area and snap == "0"
        if rng.random() < 0.15:
            options += ["--min-island-area", repr(float(self.length(rng, -3, -0.5)) ** 2)]
            self.keeps_area = False
        if rng.random() < 0.25:
            options += ["--pinches", "open"]
            self.keeps_area = False
        if rng.random() < 0.15:
            options += ["--dissolve"]
        if rng.random() < 0.2:
            self.draw_frame(rng)
        for option, share in ("--constraints", 0.15), ("--regions", 0.15):
            if rng.random() >= share:
                continue
            file = option[2:] + ".geojson"
            ring = [world.place(p) for p in any_ring(rng)]
            shape = ({"type": "Polygon", "coordinates": [ring + ring[:1]]} if option == "--regions" else
                     {"type": "LineString", "coordinates": ring})
            self.files[file] = self.layer([shape])
            options += [option, file]

    def draw_frame(self, rng):
        world = self.world
        west, south, east, north = -0.7, -0.6, 0.8, 0.7
        if world.polar:
            corners = sorted([(90 - world.half) * world.polar, 90.0 * world.polar])
            box = rng.choice([(-180, corners[0], 180, corners[1]), (-30, corners[0], 100, corners[1]),
                              (170, corners[0], -170, corners[1])])
        else:
            (west, south), (east, north) = world.place((west, south)), world.place((east, north))
            box = (west, south, east, north)
        self.options += ["--bbox=" + ",".join(repr(float(v)) for v in box)]
        if rng.random() < 0.5:
            self.options += ["--domain", "outside"]
        self.keeps_area = False

    def draw_refinement(self, rng):
        options = self.options
        options += ["--max-vertices", "6000"]
        if rng.random() < 0.4:
            options += ["--min-angle", str(rng.choice([0, 10, 20, 30, 36, 40, 42]))]
        if rng.random() < 0.1:
            options += ["--max-angle", str(rng.choice([100, 120, 140]))]
        if rng.random() < 0.1:
            options += ["--algorithm", rng.choice(["circumcenter", "offcenter", "optimal"])]
        sized = False
        if rng.random() < 0.2:
            options += ["--size", self.length(rng, -1.5, 0)]
            sized = True
        if rng.random() < 0.15:
            options += ["--size-shore", self.length(rng, -1.8, -0.5), "--shore-rate", "0.2"]
            sized = True
        if rng.random() < 0.2 or (sized and rng.random() < 0.3):
            options += ["--size-max", self.length(rng, -1.2, 0.5)]
        if sized and rng.random() < 0.5:
            options += ["--coast", "follow"]
            self.keeps_area = False
        if rng.random() < 0.15:
            options += ["--smooth"]
        if rng.random() < 0.2 and self.world.kind != "poly":
            options += ["--target", rng.choice(["adcirc", "schism", "fvcom", "telemac", "mike", "dflowfm", "swan", "fesom", "mpas"])]
            self.keeps_area = False
