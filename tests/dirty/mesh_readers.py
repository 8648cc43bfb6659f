"""Readers of what coastmesh writes, by the formats' own descriptions and nothing of coastmesh; standard library only.

`read_grid(path)` gives nodes [(x, y)] and triangles [(a, b, c)], from 0. `read_layer(path)` gives, for each triangle of a
layer in its order, the rings of its parts without the repeated last point.
"""
import json
import pathlib
import re
import sqlite3
import struct


def read_grid(path):
    name = pathlib.Path(path).name
    for ending, reader in GRIDS:
        if name.endswith(ending):
            return reader(path)
    raise ValueError(name)


def read_layer(path):
    return LAYERS[pathlib.Path(path).suffix](path)


def words(path):
    return [line.split() for line in open(path) if line.split()]


def read_netcdf(path):
    """The classic format, 64-bit offsets too: header, then each variable in one block."""
    data = pathlib.Path(path).read_bytes()
    assert data[:3] == b"CDF" and data[3] in (1, 2, 5), "no classic netCDF"
    wide, at = data[3] == 5, 4

    def take(code):
        nonlocal at
        (value,) = struct.unpack_from(">" + code, data, at)
        at += struct.calcsize(code)
        return value

    def count():
        return take("Q" if wide else "I")

    def name():
        nonlocal at
        length = count()
        text = data[at : at + length].decode()
        at += (length + 3) // 4 * 4
        return text

    sizes = {1: 1, 2: 1, 3: 2, 4: 4, 5: 4, 6: 8, 7: 1, 8: 2, 9: 4, 10: 8, 11: 8}

    def skip_attributes():
        nonlocal at
        take("I")
        for _ in range(count()):
            name()
            size = sizes[take("I")]
            length = count() * size
            at += (length + 3) // 4 * 4

    count()
    take("I")
    dimensions = []
    for _ in range(count()):
        name()
        dimensions.append(count())
    skip_attributes()
    take("I")
    variables = {}
    for _ in range(count()):
        key = name()
        shape = [dimensions[count()] for _ in range(count())]
        skip_attributes()
        kind = take("I")
        count()
        begin = take("Q" if data[3] != 1 else "I")
        variables[key] = (kind, shape, begin)

    def values(key):
        kind, shape, begin = variables[key]
        total = 1
        for length in shape:
            total *= length
        return struct.unpack_from(f">{total}{dict(zip(range(3, 12), 'hifdBHIqQ'))[kind]}", data, begin)

    faces = values("mesh2d_face_nodes")
    nodes = list(zip(values("mesh2d_node_x"), values("mesh2d_node_y")))
    base = min(faces)
    assert base in (0, 1)
    return nodes, [tuple(n - base for n in faces[i : i + 3]) for i in range(0, len(faces), 3)]


def read_2dm(path):
    nodes, triangles = {}, []
    for line in words(path):
        if line[0] == "ND":
            nodes[int(line[1])] = (float(line[2]), float(line[3]))
        elif line[0] == "E3T":
            triangles.append(tuple(int(n) for n in line[2:5]))
    return renumbered(nodes, triangles)


def read_mike(path):
    lines = words(path)
    item, unit, count = (int(word) for word in lines[0][:3])
    assert (item, unit) == (100079, 1000) and len(lines[0]) > 3
    nodes = {int(line[0]): (float(line[1]), float(line[2])) for line in lines[1 : count + 1]}
    elements = int(lines[count + 1][0])
    assert len(nodes) == count and lines[count + 1][1:] == ["3", "21"] and len(lines) == count + 2 + elements
    return renumbered(nodes, [tuple(int(n) for n in line[1:4]) for line in lines[count + 2 :]])


def renumbered(nodes, triangles):
    index = {n: i for i, n in enumerate(nodes)}
    return list(nodes.values()), [tuple(index[n] for n in t) for t in triangles]


def read_fort14(path):
    lines = open(path).read().split("\n")
    elements, count = (int(w) for w in lines[1].split()[:2])
    nodes, triangles = {}, []
    for line in lines[2 : 2 + count]:
        w = line.split()
        nodes[int(w[0])] = (float(w[1]), float(w[2]))
    for line in lines[2 + count : 2 + count + elements]:
        w = [int(n) for n in line.split()]
        assert w[1] == 3
        triangles.append(tuple(w[2:5]))
    return renumbered(nodes, triangles)


def sections(path):
    text = open(path).read()
    return {name: body.split("\n") for name, body in re.findall(r"\$(\w+)\n(.*?)\n\$End\1", text, re.S)}


def read_msh2(path):
    parts, nodes, triangles = sections(path), {}, []
    for line in parts["Nodes"][1:]:
        w = line.split()
        nodes[int(w[0])] = (float(w[1]), float(w[2]))
    for line in parts["Elements"][1:]:
        w = [int(n) for n in line.split()]
        if w[1] == 2:
            triangles.append(tuple(w[3 + w[2] : 6 + w[2]]))
    return renumbered(nodes, triangles)


def read_msh4(path):
    parts, nodes, triangles = sections(path), {}, []
    lines = iter(parts["Nodes"])
    for _ in range(int(next(lines).split()[0])):
        count = int(next(lines).split()[3])
        tags = [int(next(lines)) for _ in range(count)]
        for tag in tags:
            w = next(lines).split()
            nodes[tag] = (float(w[0]), float(w[1]))
    lines = iter(parts["Elements"])
    for _ in range(int(next(lines).split()[0])):
        _, _, kind, count = (int(n) for n in next(lines).split())
        for _ in range(count):
            w = [int(n) for n in next(lines).split()]
            if kind == 2:
                triangles.append(tuple(w[1:4]))
    return renumbered(nodes, triangles)


def read_triangle(path):
    nodes = {int(w[0]): (float(w[1]), float(w[2])) for w in words(path)[1:]}
    elements = words(pathlib.Path(path).with_suffix(".ele"))[1:]
    return renumbered(nodes, [tuple(int(n) for n in w[1:4]) for w in elements])


def read_selafin(path):
    data, at, records = pathlib.Path(path).read_bytes(), 0, []
    while at < len(data):
        (length,) = struct.unpack_from(">i", data, at)
        records.append(data[at + 4 : at + 4 + length])
        at += length + 8
    (variables,) = struct.unpack(">i", records[1][:4])
    at = 2 + variables
    dated = struct.unpack(">10i", records[at])[9] == 1
    at += 2 if dated else 1
    elements, count, corners, _ = struct.unpack(">4i", records[at])
    assert corners == 3
    flat = struct.unpack(f">{3 * elements}i", records[at + 1])
    x, y = (struct.unpack(f">{count}d", records[at + k]) for k in (3, 4))
    return list(zip(x, y)), [tuple(n - 1 for n in flat[i : i + 3]) for i in range(0, 3 * elements, 3)]


def read_vtu(path):
    data = pathlib.Path(path).read_bytes()
    head, body = data.split(b'<AppendedData encoding="raw">\n_', 1)

    def block(name, code):
        offset = int(re.search(rf'Name="{name}"[^>]*offset="(\d+)"'.encode(), head)[1])
        (length,) = struct.unpack_from("<Q", body, offset)
        return struct.unpack_from(f"<{length // struct.calcsize(code)}{code}", body, offset + 8)

    places, corners = block("Points", "d"), block("connectivity", "q")
    return ([places[i : i + 2] for i in range(0, len(places), 3)],
            [corners[i : i + 3] for i in range(0, len(corners), 3)])


def read_fvcom(path):
    lines = words(path)
    count, elements = int(lines[0][-1]), int(lines[1][-1])
    triangles = [tuple(int(n) for n in w[1:4]) for w in lines[2 : 2 + elements]]
    nodes = {int(w[0]): (float(w[1]), float(w[2])) for w in lines[2 + elements :]}
    assert len(nodes) == count
    return renumbered(nodes, triangles)


GRIDS = [("_22.msh", read_msh2), ("_ww3.msh", read_msh2), (".msh", read_msh4), (".nc", read_netcdf), (".2dm", read_2dm),
         (".14", read_fort14), (".gr3", read_fort14), (".node", read_triangle), (".slf", read_selafin),
         (".vtu", read_vtu), ("_grd.dat", read_fvcom), (".mesh", read_mike)]


def open_ring(ring):
    assert ring[0] == ring[-1]
    return [tuple(p[:2]) for p in ring[:-1]]


def read_geojson(path):
    layer = []
    for feature in json.load(open(path))["features"]:
        geometry = feature["geometry"]
        polygons = [geometry["coordinates"]] if geometry["type"] == "Polygon" else geometry["coordinates"]
        assert all(len(rings) == 1 for rings in polygons)
        layer.append([open_ring(rings[0]) for rings in polygons])
    return layer


def read_wkb(data, at):
    """A polygon or several, in two dimensions: the rings, and where the next geometry begins."""
    order = "<" if data[at] == 1 else ">"
    kind, count = struct.unpack_from(order + "II", data, at + 1)
    at += 9
    rings = []
    for _ in range(count):
        if kind == 6:
            more, at = read_wkb(data, at)
            rings += more
            continue
        assert kind == 3
        (length,) = struct.unpack_from(order + "I", data, at)
        flat = struct.unpack_from(f"{order}{2 * length}d", data, at + 4)
        at += 4 + 16 * length
        rings.append(open_ring([flat[i : i + 2] for i in range(0, 2 * length, 2)]))
    return rings, at


def read_gpkg(path):
    with sqlite3.connect(f"file:{path}?mode=ro", uri=True) as base:
        rows = base.execute("SELECT geom FROM triangles ORDER BY fid").fetchall()
    layer = []
    for (blob,) in rows:
        envelope = {0: 0, 1: 32, 2: 48, 3: 48, 4: 64}[blob[3] >> 1 & 7]
        layer.append(read_wkb(blob, 8 + envelope)[0])
    return layer


def read_shapefile(path):
    data, at, layer = pathlib.Path(path).read_bytes(), 100, []
    while at < len(data):
        (length,) = struct.unpack_from(">I", data, at + 4)
        kind, parts, count = struct.unpack_from("<i", data, at + 8) + struct.unpack_from("<ii", data, at + 44)
        assert kind == 5
        starts = list(struct.unpack_from(f"<{parts}i", data, at + 52)) + [count]
        flat = struct.unpack_from(f"<{2 * count}d", data, at + 52 + 4 * parts)
        places = [flat[i : i + 2] for i in range(0, 2 * count, 2)]
        layer.append([open_ring(places[a:b]) for a, b in zip(starts, starts[1:])])
        at += 8 + 2 * length
    return layer


LAYERS = {".geojson": read_geojson, ".gpkg": read_gpkg, ".shp": read_shapefile}
