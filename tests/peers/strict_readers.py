"""Strict readers of ocean models' grids, by the rules that the models read them by and nothing of coastmesh.

Each gives a dict: nodes [(x, y)], triangles [(a, b, c)] from 0, depth [positive down], open [[node]], land [[node]] where
the format has them. What the model would refuse raises Refused.
"""

import math
import re
import struct


class Refused(Exception):
    pass


def require(condition, text):
    if not condition:
        raise Refused(text)


def area(nodes, triangle):
    (ax, ay), (bx, by), (cx, cy) = (nodes[n] for n in triangle)
    return ((bx - ax) * (cy - ay) - (cx - ax) * (by - ay)) / 2


def check_mesh(nodes, triangles):
    """Counter-clockwise, every node used, every edge in one or two triangles that run along it differently."""
    edges = {}
    used = set()
    for t in triangles:
        require(len(set(t)) == 3 and all(0 <= n < len(nodes) for n in t), f"triangle {t}")
        require(area(nodes, t) > 0, f"triangle {t} is not counter-clockwise")
        used.update(t)
        for i in range(3):
            edge = (t[i], t[(i + 1) % 3])
            require(edge not in edges, f"edge {edge} runs the same way twice")
            edges[edge] = t
    require(len(used) == len(nodes), "nodes without a triangle")
    return {edge for edge in edges if edge[::-1] not in edges}


def check_fans(boundary):
    """No pinch: one edge of the boundary leaves each of its nodes."""
    starts = [edge[0] for edge in boundary]
    require(len(set(starts)) == len(starts), "the mesh touches itself in a node")


def read_fort14(path, schism=False, allow_pinches=False):
    lines = open(path).read().split("\n")
    at = 1

    def numbers(count):
        nonlocal at
        words = lines[at].split("=")[0].split()
        require(len(words) >= count, f"line {at + 1}")
        at += 1
        return words

    ne, np = (int(w) for w in numbers(2)[:2])
    nodes, depth, triangles = [], [], []
    for i in range(np):
        words = numbers(4)
        require(int(words[0]) == i + 1 and len(words) == 4, f"node {i + 1}")
        nodes.append((float(words[1]), float(words[2])))
        depth.append(float(words[3]))
    for i in range(ne):
        words = [int(w) for w in numbers(5)]
        require(words[0] == i + 1 and words[1] == 3 and len(words) == 5, f"element {i + 1}")
        triangles.append(tuple(n - 1 for n in words[2:]))
    boundary = check_mesh(nodes, triangles)
    if not allow_pinches:
        check_fans(boundary)
    open_segments, land = [], []
    count, total = int(numbers(1)[0]), int(numbers(1)[0])
    for _ in range(count):
        length = int(numbers(1)[0])
        open_segments.append([int(numbers(1)[0]) - 1 for _ in range(length)])
    require(sum(map(len, open_segments)) == total, "NETA is not the sum")
    count, total = int(numbers(1)[0]), int(numbers(1)[0])
    types = []
    for _ in range(count):
        length, kind = (int(w) for w in numbers(2)[:2])
        types.append(kind)
        land.append([int(numbers(1)[0]) - 1 for _ in range(length)])
    require(sum(map(len, land)) == total, "NVEL is not the sum")
    require(all(not line.strip() for line in lines[at:]), "lines after the end")
    told = []
    for segment in open_segments:
        require(len(segment) >= 2 and segment[0] != segment[-1], "an open segment that ends where it starts")
        told += zip(segment, segment[1:])
    for kind, segment in zip(types, land):
        island = kind == 1 if schism else kind in (1, 11, 21)
        require(len(segment) >= 2 and segment[0] != segment[-1], "a land segment that ends where it starts")
        told += zip(segment, segment[1:])
        if island:
            told.append((segment[-1], segment[0]))
            around = sum(
                nodes[a][0] * nodes[b][1] - nodes[b][0] * nodes[a][1] for a, b in zip(segment, segment[1:] + segment[:1])
            )
            require(around < 0 or allow_pinches, "an island that goes counter-clockwise")
        require(kind in ((0, 1) if schism else (0, 1, 2, 10, 11, 12, 20, 21, 22)), f"type {kind}")
    require(len(set(told)) == len(told), "an edge of the boundary in two segments")
    require(set(told) == boundary, "segments are not the boundary")
    return {"nodes": nodes, "triangles": triangles, "depth": depth, "open": open_segments, "land": land}


def read_mike(path):
    """As DHI's specification has it: edges of the boundary get their codes from those of their nodes."""
    with open(path) as file:
        item, unit, count, projection = file.readline().split(maxsplit=3)
        require((item, unit) == ("100079", "1000") and projection.strip(), "the first line")
        nodes, depth, codes = [], [], []
        for number in range(1, int(count) + 1):
            words = file.readline().split()
            require(len(words) == 5 and int(words[0]) == number, "a node")
            nodes.append((float(words[1]), float(words[2])))
            depth.append(-float(words[3]))
            codes.append(int(words[4]))
        elements, most, kind = (int(word) for word in file.readline().split())
        require((most, kind) == (3, 21), "the kind of elements")
        triangles = []
        for number in range(1, elements + 1):
            words = [int(word) for word in file.readline().split()]
            require(len(words) == 4 and words[0] == number, "an element")
            triangles.append(tuple(node - 1 for node in words[1:]))
        require(not file.read(), "something behind the elements")
    boundary = check_mesh(nodes, triangles)
    on_boundary = {node for edge in boundary for node in edge}
    require(all((codes[node] > 0) == (node in on_boundary) for node in range(len(nodes))), "codes of nodes")
    is_open = {edge: min(codes[node] for node in edge) > 1 for edge in boundary}
    return {"nodes": nodes, "triangles": triangles, "depth": depth,
            "open": [list(edge) for edge in boundary if is_open[edge]],
            "land": [list(edge) for edge in boundary if not is_open[edge]]}


def read_2dm(path):
    nodes, triangles, depth, strings, part, materials, in_block = [], [], [], [], [], [], False
    with open(path) as file:
        require(file.readline().strip() == "MESH2D", "it does not start with MESH2D")
        for line in file:
            words = line.split()
            if words[0] == "E3T":
                require(len(words) == 6 and int(words[1]) == len(triangles) + 1, line)
                triangles.append(tuple(int(n) - 1 for n in words[2:5]))
            elif words[0] == "ND":
                require(len(words) == 5 and int(words[1]) == len(nodes) + 1, line)
                nodes.append((float(words[2]), float(words[3])))
                depth.append(-float(words[4]))
            elif words[0] == "NS":
                numbers = [int(w) for w in words[1:]]
                require(len([n for n in numbers[:10]]) <= 10, line)
                ends = [k for k, n in enumerate(numbers) if n < 0]
                part += [abs(n) - 1 for n in (numbers[: ends[0] + 1] if ends else numbers)]
                if ends:
                    strings.append(part)
                    part = []
            elif words[0] == "BEG2DMBC":
                require(not materials, "a second block of materials")
                in_block = True
            elif words[0] == "MAT" and in_block:
                number, name = line.split(maxsplit=1)[1].split(maxsplit=1)
                require(int(number) == len(materials) + 1 and re.fullmatch(r'"[^"]*"\s*', name), line)
                materials.append(name.strip()[1:-1])
            elif words[0] == "END2DMBC" and in_block:
                in_block = False
            else:
                raise Refused(line)
    require(not part, "a node string without an end")
    require(not in_block, "a block of materials without an end")
    check_mesh(nodes, triangles)
    return {"nodes": nodes, "triangles": triangles, "depth": depth, "strings": strings}


def read_selafin(path):
    data = open(path, "rb").read()
    at = 0

    def record():
        nonlocal at
        (size,) = struct.unpack_from(">i", data, at)
        (after,) = struct.unpack_from(">i", data, at + 4 + size)
        require(size == after, f"record at byte {at}")
        body = data[at + 4 : at + 4 + size]
        at += size + 8
        return body

    title = record()
    require(len(title) == 80 and title[72:] in (b"SERAFIN ", b"SERAFIND"), "title")
    real = "d" if title[72:] == b"SERAFIND" else "f"
    nbv1, nbv2 = struct.unpack(">2i", record())
    names = [record() for _ in range(nbv1 + nbv2)]
    require(nbv2 == 0 and all(len(name) == 32 for name in names) and names[0].startswith(b"BOTTOM"), "variables")
    parameters = struct.unpack(">10i", record())
    require(parameters[9] == 0, "a date")
    nelem, npoin, corners, one = struct.unpack(">4i", record())
    require(corners == 3 and one == 1, "sizes")
    ikle = struct.unpack(f">{3 * nelem}i", record())
    ipobo = struct.unpack(f">{npoin}i", record())
    x, y = (struct.unpack(f">{npoin}{real}", record()) for _ in range(2))
    struct.unpack(f">{real}", record())
    bottom = struct.unpack(f">{npoin}{real}", record())
    require(at == len(data), "bytes after the end")
    nodes = list(zip(x, y))
    triangles = [tuple(n - 1 for n in ikle[3 * t : 3 * t + 3]) for t in range(nelem)]
    boundary = check_mesh(nodes, triangles)
    check_fans(boundary)
    after = dict(boundary)
    ranks = sorted((rank, node) for node, rank in enumerate(ipobo) if rank)
    require([rank for rank, _ in ranks] == list(range(1, len(ranks) + 1)), "IPOBO is not 1, 2, 3 ...")
    order = [node for _, node in ranks]
    require(set(order) == set(after), "IPOBO is not the boundary")
    rows = [line.split() for line in open(str(path)[:-4] + ".cli")]
    require(len(rows) == len(order), "the .cli has not a line a node of the boundary")
    codes = []
    for k, row in enumerate(rows):
        require(len(row) == 13 and int(row[11]) == order[k] + 1 and int(row[12]) == k + 1, f".cli line {k + 1}")
        codes.append(tuple(int(c) for c in row[:3]))
        require(codes[-1] in ((2, 2, 2), (5, 4, 4), (4, 5, 5), (5, 6, 6)), f".cli line {k + 1}")
    # Ranks run along the boundary, loop after loop; the first loop starts at its south-western node.
    start = 0
    while start < len(order):
        loop = [order[start]]
        while after[loop[-1]] != order[start]:
            loop.append(after[loop[-1]])
        require(order[start : start + len(loop)] == loop, "ranks do not follow the boundary")
        require(min(loop, key=lambda n: x[n] + y[n]) == loop[0], "a loop does not start in the south-west")
        if start == 0:
            around = sum(x[a] * y[b] - x[b] * y[a] for a, b in zip(loop, loop[1:] + loop[:1]))
            require(around > 0, "the first loop is no outer one")
        liquid = [codes[start + k][0] != 2 for k in range(len(loop))]
        for k in range(len(loop)):
            lone = liquid[k] and not liquid[k - 1] and not liquid[(k + 1) % len(loop)]
            require(not lone, "a single open node between walls")
        start += len(loop)
    is_open = {node for node, code in zip(order, codes) if code[0] == 5}
    return {"nodes": nodes, "triangles": triangles, "depth": [-z for z in bottom], "open_nodes": is_open}


def read_fvcom(path):
    base = str(path)[: -len("_grd.dat")]

    def counted(name, *what):
        lines = open(f"{base}_{name}.dat").read().splitlines()
        counts = []
        for word in what:
            left, right = lines.pop(0).split("=")
            require(left.strip() == word, f"{name}: {word}")
            counts.append(int(right))
        return counts, [line.split() for line in lines]

    (np, ne), rows = counted("grd", "Node Number", "Cell Number")
    require(len(rows) == np + ne, "_grd.dat: rows")
    triangles = []
    for t, row in enumerate(rows[:ne]):
        require(int(row[0]) == t + 1 and len(row) == 5, f"cell {t + 1}")
        triangles.append(tuple(int(n) - 1 for n in row[1:4]))
    nodes = []
    for i, row in enumerate(rows[ne:]):
        require(int(row[0]) == i + 1 and len(row) == 4, f"node {i + 1}")
        nodes.append((float(row[1]), float(row[2])))
    boundary = check_mesh(nodes, triangles)
    (count,), rows_dep = counted("dep", "Node Number")
    require(count == np == len(rows_dep), "_dep.dat: count")
    require([(float(r[0]), float(r[1])) for r in rows_dep] == nodes, "_dep.dat: places")
    (count,), rows_cor = counted("cor", "Node Number")
    require(count == np == len(rows_cor) and all(-90 <= float(r[2]) <= 90 for r in rows_cor), "_cor.dat")
    (count,), rows_obc = counted("obc", "OBC Node Number")
    require(count == len(rows_obc), "_obc.dat: count")
    is_open = {int(row[1]) - 1 for row in rows_obc}
    require(len(is_open) == count and all(int(row[2]) == 1 for row in rows_obc), "_obc.dat: rows")
    inner = {frozenset(e) for e in boundary}
    for t in triangles:
        outer = [(t[i], t[(i + 1) % 3]) for i in range(3) if frozenset((t[i], t[(i + 1) % 3])) in inner]
        opened = [e for e in outer if e[0] in is_open and e[1] in is_open]
        require(len(outer) < 3, "a cell without a neighbour")
        require(len(opened) < 2, "a cell with two open edges")
        require(not opened or len(outer) == 1, "a cell with an open and a solid edge")
    return {"nodes": nodes, "triangles": triangles, "depth": [float(r[2]) for r in rows_dep], "open_nodes": is_open}


def check_swan(nodes, triangles, boundary):
    """SwanCheckGrid: cosines of angles, of coordinates as they stand, above -0.8; 4 to 10 triangles round an inner node."""
    on_boundary = {node for edge in boundary for node in edge}
    round_node = [0] * len(nodes)
    for t in triangles:
        square = [(nodes[t[i - 1]][0] - nodes[t[i - 2]][0]) ** 2 + (nodes[t[i - 1]][1] - nodes[t[i - 2]][1]) ** 2 for i in range(3)]
        for i in range(3):
            a, b, c = square[i], square[i - 1], square[i - 2]
            require((b + c - a) / (2 * math.sqrt(b * c)) > -0.8, f"an angle of triangle {t}")
            round_node[t[i]] += 1
    for node, count in enumerate(round_node):
        require(node in on_boundary or 4 <= count <= 10, f"{count} triangles round node {node}")


def on_sphere(place):
    x, y = math.radians(place[0]), math.radians(place[1])
    return (math.cos(y) * math.cos(x), math.cos(y) * math.sin(x), math.sin(y))


def flow_centre(corners):
    """The circumcentre, or where the way there from the centre of gravity leaves the triangle; and the triangle's area."""
    square = [sum((p - q) ** 2 for p, q in zip(corners[i - 1], corners[i - 2])) for i in range(3)]
    weights = [square[i] * (square[i - 1] + square[i - 2] - square[i]) for i in range(3)]
    sixteen_areas_squared = sum(weights)
    weights = [w / sixteen_areas_squared for w in weights]
    reach = min([1.0] + [(1 / 3) / (1 / 3 - w) for w in weights if w < 0])
    weights = [1 / 3 + reach * (w - 1 / 3) for w in weights]
    centre = [sum(w * corner[k] for w, corner in zip(weights, corners)) for k in range(3)]
    return centre, math.sqrt(sixteen_areas_squared) / 4


def check_dflowfm(nodes, triangles):
    """Longitudes and latitudes. Flow links: no shorter than 0.1 of half the sum of the roots of the areas beside them
    (removesmalllinkstrsh), and crossing their edge at a cosine of 0.5 or less. Returns how many there are."""
    slack = 1e-3  # tolerance, since the program uses another plane
    points = [on_sphere(place) for place in nodes]
    beside, links = {}, 0
    for t in triangles:
        centre, size = flow_centre([points[n] for n in t])
        for i in range(3):
            edge = (t[i], t[(i + 1) % 3])
            if edge[::-1] not in beside:
                beside[edge] = centre, size
                continue
            other, other_size = beside[edge[::-1]]
            link = [p - q for p, q in zip(centre, other)]
            along = [p - q for p, q in zip(points[edge[0]], points[edge[1]])]
            length = math.hypot(*link)
            shortest = 0.1 * 0.5 * (math.sqrt(size) + math.sqrt(other_size))
            require(length >= (1 - slack) * shortest, f"a flow link of {length / shortest} across edge {edge}")
            cosine = abs(sum(p * q for p, q in zip(link, along))) / length / math.hypot(*along)
            require(cosine <= 0.5 + slack, f"a flow link across edge {edge} at a cosine of {cosine}")
            links += 1
    return links
