"""Small inputs for the golden runs, the same bytes on every machine: arithmetic only, no library, no trigonometry."""

import json
import pathlib
import random

DATA = pathlib.Path(__file__).resolve().parent.parent.parent / "data"
WGS84 = ('GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137.0,298.257223563]],'
         'PRIMEM["Greenwich",0.0],UNIT["Degree",0.0174532925199433]]')


def utm_prj(zone):
    return (f'PROJCS["WGS_1984_UTM_Zone_{zone}N",{WGS84},PROJECTION["Transverse_Mercator"],'
            f'PARAMETER["False_Easting",500000.0],PARAMETER["False_Northing",0.0],'
            f'PARAMETER["Central_Meridian",{6 * zone - 183}.0],PARAMETER["Scale_Factor",0.9996],'
            f'PARAMETER["Latitude_Of_Origin",0.0],UNIT["Meter",1.0]]')


def utm16(x, y):
    """Metres where EPSG:32616 has Lake Superior, near enough."""
    return (500000.0 + 76000.0 * (x + 87.0), 5270000.0 + 111000.0 * (y - 47.6))


def utm19(x, y):
    """And EPSG:32619 Hispaniola."""
    return (500000.0 + 105000.0 * (x + 69.0), 2100000.0 + 110600.0 * (y - 19.0))


def box(west, south, east, north):
    return [(west, south), (east, south), (east, north), (west, north)]


def polygon(*rings):
    return {"type": "Polygon", "coordinates": [[*ring, ring[0]] for ring in rings]}


def line(*points):
    return {"type": "LineString", "coordinates": points}


def point(x, y):
    return {"type": "Point", "coordinates": [x, y]}


def write_features(path, features, crs=None):
    """`features`: geometry and properties of each."""
    collection = {"type": "FeatureCollection"}
    if crs:
        collection["crs"] = {"type": "name", "properties": {"name": crs}}
    collection["features"] = [{"type": "Feature", "properties": p, "geometry": g} for g, p in features]
    path.write_text(json.dumps(collection))


def write_poly(path, points, segments, holes=()):
    lines = [f"{len(points)} 2 0 0"] + [f"{i} {x!r} {y!r}" for i, (x, y) in enumerate(points)]
    lines += [f"{len(segments)} 0"] + [f"{i} {a} {b}" for i, (a, b) in enumerate(segments)]
    lines += [str(len(holes))] + [f"{i} {x!r} {y!r}" for i, (x, y) in enumerate(holes)]
    path.write_text("\n".join(lines) + "\n")


def ring_segments(first, count):
    return [(first + i, first + (i + 1) % count) for i in range(count)]


def placed(coordinates, place):
    if isinstance(coordinates[0], (int, float)):
        return place(*coordinates)
    return [placed(part, place) for part in coordinates]


def write_placed(path, features, place, crs):
    write_features(path, [({**g, "coordinates": placed(g["coordinates"], place)}, p) for g, p in features], crs)


def features_of(name):
    collection = json.loads((DATA / name).read_text())
    return [(f["geometry"], {"name": f["properties"]["name"]}) for f in collection["features"]]


def write_grid(path, corner, pixel, columns, rows, value, prj=WGS84):
    """An ESRI ASCII grid; `value` of the middle of a pixel counted from the corner, None where there is none."""
    lines = [f"ncols {columns}", f"nrows {rows}", f"xllcorner {corner[0]}", f"yllcorner {corner[1]}",
             f"cellsize {pixel}", "NODATA_value -9999"]
    for row in range(rows - 1, -1, -1):
        values = [value((column + 0.5) / columns, (row + 0.5) / rows) for column in range(columns)]
        lines.append(" ".join("-9999" if v is None else f"{v:.3f}" for v in values))
    path.write_text("\n".join(lines) + "\n")
    path.with_suffix(".prj").write_text(prj)


def lake_elevation(x, y):
    """A trough from west to east, down to 300 m; unknown in the south-west; land in the north."""
    if x < 0.25 and y < 0.25:
        return None
    return 50.0 if y > 0.85 else -300.0 + 1500.0 * (y - 0.5) ** 2 + 80.0 * (x - 0.5)


def sea_elevation(x, y):
    """Deeper to the north-east, 10 to 3,000 m; with a shoal."""
    shoal = max(0.0, 1.0 - 40.0 * ((x - 0.75) ** 2 + (y - 0.8) ** 2))
    return -10.0 - 400.0 * x - 2700.0 * max(0.0, y - 0.2) + 1500.0 * shoal


def make_planes(folder):
    """.poly files: no CRS at all."""
    write_poly(folder / "square.poly", box(0.0, 0.0, 1.0, 1.0), ring_segments(0, 4))
    # Erten and Üngör's "Boxed Point Pair", and random points like theirs.
    write_poly(folder / "boxed_pair.poly", box(0.0, 0.0, 100.0, 100.0) + [(49.5, 50.0), (50.5, 50.0)],
               ring_segments(0, 4))
    chance = random.Random(7)
    write_poly(folder / "random1000.poly",
               box(0.0, 0.0, 1.0, 1.0) + [(chance.random(), chance.random()) for _ in range(1000)], ring_segments(0, 4))
    # Rays from one vertex, 1 to 20 degrees apart, in a box with a hole.
    rays = [(3.0, 0.0), (3.0, 0.05), (2.5, 0.3), (2.9, 0.9), (2.0, 1.1), (2.2, 1.9)]
    write_poly(folder / "fan.poly", box(-2.0, -2.0, 4.0, 4.0) + box(-1.0, 2.0, 0.0, 3.0) + [(0.0, 0.0)] + rays,
               ring_segments(0, 4) + ring_segments(4, 4) + [(8, 9 + i) for i in range(len(rays))], [(-0.5, 2.5)])
    # A comb: teeth ten times as high as wide.
    teeth = []
    for i in range(12):
        teeth += [(2.0 * i, 10.0), (2.0 * i, 0.0), (2.0 * i + 1.0, 0.0), (2.0 * i + 1.0, 10.0)]
    teeth += [(23.0, 12.0), (0.0, 12.0)]
    write_poly(folder / "comb.poly", teeth, ring_segments(0, len(teeth)))


def make_maps(folder):
    """In metres of UTM zones, to be meshed as they are: no projection rounds anything."""
    # A lake with two islands that touch in a point, and a lake divided along the border of two sheets.
    shore = [(500000, 5000000), (503000, 4999400), (506000, 5000200), (506500, 5003000), (504000, 5005200),
             (501000, 5005000), (499500, 5002600)]
    islands = [[(502000, 5002000), (502400, 5002600), (503000, 5002500), (502800, 5001800)],
               [(503000, 5002500), (503300, 5003100), (503900, 5002900), (503500, 5002300)]]
    write_features(folder / "touching.geojson", [(polygon(shore, *islands), {"name": "lake"})], "EPSG:32631")
    write_features(folder / "sheets.geojson",
                   [(polygon(box(500000, 5000000, 502000, 5003000)), {"name": "west"}),
                    (polygon(box(502000, 5000000, 504000, 5003000)), {"name": "east"})], "EPSG:32631")

    write_placed(folder / "superior.geojson", features_of("lake_superior.geojson"), utm16, "EPSG:32616")
    in_superior = {
        "transects": [(line((-87.5, 47.8), (-86.5, 48.2), (-85.9, 47.9)), {}), (point(-87.0, 47.3), {}),
                      (point(-86.0, 47.3), {})],
        "walls": [(line((-87.4, 47.2), (-86.9, 47.0)), {})],
        "parts": [(polygon(box(-88.0, 46.0, -86.0, 49.0)), {"name": "middle"}),
                  (polygon(box(-86.0, 46.0, -84.0, 49.0)), {"name": "east"})],
        "frame": [(polygon([(-88.3, 47.4), (-85.3, 47.1), (-85.8, 48.3)]), {})],
        "open": [(polygon(box(-84.8, 46.3, -84.2, 46.7)), {"type": "open"}),
                 (polygon(box(-92.2, 46.6, -91.9, 46.9)), {"type": "river"})],
        "wanted": [(point(-87.0, 47.6), {"size": 500, "rate": 0.2}),
                   (line((-89.0, 47.2), (-88.6, 47.3)), {"size": 1500, "rate": 0.1}),
                   (polygon(box(-86.5, 47.0, -86.0, 47.3)), {"size": 3000, "rate": None})],
    }
    for name, features in in_superior.items():
        write_placed(folder / f"{name}.geojson", features, utm16, "EPSG:32616")
    corner = utm16(-93.0, 46.0)
    write_grid(folder / "wanted.asc", corner, 20000.0, 34, 18,
               lambda x, y: 4000.0 + 40000.0 * (x - 0.5) ** 2 if x < 0.8 else None, utm_prj(16))
    write_grid(folder / "lake_bed.asc", corner, 10000.0, 68, 36, lake_elevation, utm_prj(16))

    write_placed(folder / "hispaniola.geojson", features_of("samples/hispaniola.geojson"), utm19, "EPSG:32619")
    write_grid(folder / "sea_bed.asc", utm19(-76.0, 16.0), 10000.0, 95, 62, sea_elevation, utm_prj(19))
    write_placed(folder / "finnish_lakes.geojson", features_of("samples/finnish_lakes.geojson"),
                 lambda x, y: (500000.0 + 52000.0 * (x - 29.6), 6900000.0 + 111400.0 * (y - 62.3)), "EPSG:32635")
    # Rings that intersect themselves.
    write_placed(folder / "crossed.geojson", features_of("samples/belgium_luxembourg.geojson"),
                 lambda x, y: (600000.0 + 70000.0 * (x - 4.5), 5600000.0 + 111200.0 * (y - 50.5)), "EPSG:32631")
    # A coast as several lines, with water to their right, and an island.
    write_features(folder / "coast.geojson",
                   [(line((350000, 60000), (260000, 90000), (210000, 50000), (160000, 100000)), {}),
                    (line((160000, 100000), (90000, 70000), (-50000, 90000)), {}),
                    (line((100000, 150000), (110000, 130000), (140000, 140000), (130000, 160000), (100000, 150000)), {})],
                   "EPSG:32631")


def make_earth(folder):
    """In longitudes and latitudes."""
    write_features(folder / "continents.geojson",
                   [(polygon(box(-120.0, -40.0, -60.0, 60.0)), {}), (polygon(box(-10.0, -30.0, 60.0, 70.0)), {}),
                    (polygon(box(100.0, -20.0, 150.0, 30.0)), {})])
    write_grid(folder / "sea_bed_wgs84.asc", (-76.0, 16.0), 0.1, 90, 56, sea_elevation)


def make(folder):
    make_planes(folder)
    make_maps(folder)
    make_earth(folder)
