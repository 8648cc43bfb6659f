#!/usr/bin/python3
"""Tests the page that `coastmesh plot -o mesh.html` writes, in a headless Chromium with software rendering: compares
colours of pixels and texts with the mesh file, as this test reads it. Saves screenshots in PICTURES. Exit code 77:
Chromium or a Python module is missing.

usage: page_test.py PROGRAM DATA PICTURES
"""
import json
import math
import os
import random
import re
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy
    import browser
    from osgeo import gdal
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)

PROGRAM, DATA, PICTURES = (os.path.abspath(path) for path in sys.argv[1:4])
WIDTH, HEIGHT = 1280, 800
gdal.UseExceptions()


def write_grid(path, across, up, seed):
    """Writes a jittered lattice of 4 by 2.4 degrees as fort.14, open in the west, with depths growing to the east."""
    chance = random.Random(seed)
    step = 4.0 / across
    with open(path, "w", encoding="utf-8") as file:
        print("lattice", file=file)
        print(2 * across * up, (across + 1) * (up + 1), file=file)
        for row in range(up + 1):
            for column in range(across + 1):
                inside = 0 < row < up and 0 < column < across
                x, y = (chance.uniform(-0.3, 0.3) * step if inside else 0.0 for _ in range(2))
                x, y = -5.0 + column * step + x, 43.0 + row * 2.4 / up + y
                print(row * (across + 1) + column + 1, f"{x:.7f} {y:.7f} {10.0 + 20.0 * (x + 5.0):.4f}", file=file)
        number = 0
        for row in range(up):
            for column in range(across):
                a = row * (across + 1) + column + 1
                b, c, d = a + 1, a + across + 1, a + across + 2
                for corners in ((a, b, d), (a, d, c)):
                    number += 1
                    print(number, 3, *corners, file=file)
        west = [row * (across + 1) + 1 for row in range(up, -1, -1)]
        south = list(range(1, across + 2))
        east = [row * (across + 1) + across + 1 for row in range(1, up + 1)]
        north = [up * (across + 1) + column + 1 for column in range(across - 1, -1, -1)]
        land = south + east + north
        print(1, len(west), len(west), *west, sep="\n", file=file)
        print(1, len(land), f"{len(land)} 0", *land, sep="\n", file=file)


def read_grid(path):
    """Returns the file's nodes (x, y, depth) and triangles (nodes counted from 0)."""
    with open(path, encoding="utf-8") as file:
        rows = file.read().split("\n")
    triangles, nodes = map(int, rows[1].split()[:2])
    places = numpy.array([[float(word) for word in row.split()[1:4]] for row in rows[2:2 + nodes]])
    corners = numpy.array([[int(word) - 1 for word in row.split()[2:5]] for row in rows[2 + nodes:2 + nodes + triangles]])
    return places, corners


def angles_of(points):
    """Returns degrees, for triangles as an array of (triangle, corner, axis)."""
    angles = []
    for c in range(3):
        u, v = points[:, (c + 1) % 3] - points[:, c], points[:, (c + 2) % 3] - points[:, c]
        angles.append(numpy.degrees(numpy.arctan2(abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]), (u * v).sum(axis=1))))
    return numpy.array(angles).T


def pixels_of(png):
    gdal.FileFromMemBuffer("/vsimem/shot.png", png)
    dataset = gdal.Open("/vsimem/shot.png")
    pixels = dataset.ReadAsArray()[:3].transpose(1, 2, 0).astype(int)
    dataset = None
    gdal.Unlink("/vsimem/shot.png")
    return pixels


def facts_of(html):
    with open(html, encoding="utf-8") as file:
        return json.loads(re.search(r'<script type="application/json" id="facts">(.*?)</script>', file.read()).group(1))


def plot(*arguments):
    return subprocess.run([PROGRAM, "plot", *arguments], capture_output=True, text=True, check=False, timeout=120)


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.grid = cls.path("lattice.14")
        write_grid(cls.grid, 40, 24, 7)
        cls.places, cls.corners = read_grid(cls.grid)
        cls.points = cls.places[cls.corners][:, :, :2]
        cls.middles = cls.points.mean(axis=1)
        cls.angles = angles_of(cls.points)
        cls.plane, cls.earth = cls.path("plane.html"), cls.path("earth.html")
        for arguments in ([cls.grid, "-o", cls.plane], [cls.grid, "-o", cls.earth, "--assume-crs", "EPSG:4326"]):
            run = plot(*arguments)
            assert run.returncode == 0, run.stderr
        os.makedirs(PICTURES, exist_ok=True)
        cls.browser = browser.Browser(WIDTH, HEIGHT)
        cls.addClassCleanup(cls.browser.end)
        cls.addClassCleanup(cls.folder.cleanup)

    @classmethod
    def path(cls, name):
        return os.path.join(cls.folder.name, name)

    def setUp(self):
        self.browser.resize(WIDTH, HEIGHT)
        self.browser.prefer("light")

    # What the browser displays.

    def open(self, html):
        self.browser.open(html)
        self.browser.wait(lambda: self.browser.evaluate(
            "document.documentElement?.dataset.firstPicture !== undefined || document.documentElement?.dataset.failed !== undefined"), "a picture")
        self.assertEqual(self.said(), "")

    def said(self):
        return self.browser.evaluate("document.getElementById('message').textContent")

    def text(self, selector):
        return self.browser.evaluate(f"document.querySelector({json.dumps(selector)})?.innerText ?? ''")

    def settled(self):
        """Waits until drawing is complete and returns the pixels of the window."""
        self.browser.wait(lambda: self.browser.evaluate("page.frame === null && !page.moved && page.drawing.fits(page.drawing.front, page.view)"),
                          "the picture to rest")
        # Wait for the frame after that, which the screenshot shows.
        self.browser.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
        return pixels_of(self.browser.screenshot())

    def window(self):
        """Returns the width and height of the map, which is beside the panel."""
        return self.browser.evaluate("(() => { const box = document.getElementById('picture').getBoundingClientRect(); return [box.width, box.height]; })()")

    def on_screen(self, points, zoom=1.0, moved=(0.0, 0.0)):
        """Returns the screen positions of points, with the whole mesh fitted to the map, then zoomed and moved."""
        width, height = self.window()
        scale = 0.95 * min(width / 4.0, height / 2.4) * zoom
        points = numpy.asarray(points)
        return numpy.stack([width / 2 + (points[..., 0] + 3.0) * scale + moved[0], height / 2 - (points[..., 1] - 44.2) * scale + moved[1]], axis=-1)

    def plain(self):
        """Switches edges and boundaries off."""
        self.browser.key("e")
        self.browser.key("b")

    def expect_colors(self, pixels, shares, screen, palette, name, tolerance=3, least=100):
        """Checks that pixels at `screen` that are on the map have the colours of the palette at `shares`."""
        width, height = self.window()
        colors = numpy.array(palette)[numpy.rint(numpy.clip(shares, 0, 1) * (len(palette) - 1)).astype(int)]
        checked = 0
        for (x, y), color in zip(screen, colors):
            if not (5 < x < width - 55 and 5 < y < height - 60):
                continue  # buttons and scale
            seen = pixels[int(y), int(x)]
            self.assertLessEqual(abs(seen - color).max(), tolerance, f"{name}: at {x:.1f}, {y:.1f} {seen}, expected {color}")
            checked += 1
        self.assertGreater(checked, least, name)

    def picked(self):
        rows = self.browser.evaluate("[...document.querySelectorAll('#picked tr')].map(row => [...row.cells].map(cell => cell.textContent))")
        return self.text("#picked h2"), dict(rows)

    def wait_picked(self, heading):
        self.browser.wait(lambda: self.text("#picked h2") == heading, heading)
        return self.picked()[1]

    def tearDown(self):
        self.assertEqual(self.browser.complaints(), [])

    # Tests.

    def test_triangles_have_the_colours_of_their_angles(self):
        self.open(self.plane)
        self.plain()
        self.assertEqual(self.text("h1"), "lattice")
        self.assertIn("1,025 nodes, 1,920 triangles", self.text("#about"))
        pixels = self.settled()
        palette = facts_of(self.plane)["palettes"]["ramp"]
        shares = self.angles.min(axis=1) / 60.0
        self.expect_colors(pixels, shares, self.on_screen(self.middles), palette, "all of it", least=1500)
        self.browser.key("+")
        self.expect_colors(self.settled(), shares, self.on_screen(self.middles, 1.5), palette, "closer")

    def test_edges_and_boundaries_are_drawn(self):
        self.open(self.plane)
        before = self.settled()
        self.browser.screenshot(os.path.join(PICTURES, "page_light.png"))
        self.plain()
        after = self.settled()
        # Across the middle of an inner edge, in the middle row of nodes.
        a, b = 12 * 41 + 20, 12 * 41 + 21
        (ax, ay), (bx, by) = self.on_screen(self.places[[a, b], :2])
        x, y = int((ax + bx) / 2), int((ay + by) / 2)
        self.assertLess(before[y - 2:y + 3, x].sum(axis=1).min() + 100, after[y - 2:y + 3, x].sum(axis=1).min())
        # The open boundary in the west is pink, the shore dark.
        left, top = self.on_screen([-5.0, 44.2])
        rows = before[int(top), int(left) - 3:int(left) + 4]
        self.assertTrue(any(r > 180 and g < 110 and b > 100 for r, g, b in rows), rows)
        right, top = self.on_screen([-1.0, 44.2])
        rows = before[int(top), int(right) - 3:int(right) + 4]
        self.assertTrue(any(max(pixel) < 130 for pixel in rows), rows)
        self.assertEqual(self.browser.evaluate("[...document.querySelectorAll('#line-kinds li')].map(item => item.textContent)"), ["land", "open boundary"])

    def test_arrow_keys_move_and_zero_shows_all(self):
        self.open(self.plane)
        self.plain()
        palette, shares = facts_of(self.plane)["palettes"]["ramp"], self.angles.min(axis=1) / 60.0
        self.browser.key("+")
        self.browser.key("ArrowRight")
        self.browser.key("ArrowDown")
        self.expect_colors(self.settled(), shares, self.on_screen(self.middles, 1.5, (-80, -80)), palette, "moved")
        self.browser.key("0")
        self.expect_colors(self.settled(), shares, self.on_screen(self.middles), palette, "back", least=1500)

    def test_the_mouse_drags_and_zooms_where_it_is(self):
        self.open(self.plane)
        self.plain()
        palette, shares = facts_of(self.plane)["palettes"]["ramp"], self.angles.min(axis=1) / 60.0
        self.browser.drag((400, 400), (520, 350))
        self.expect_colors(self.settled(), shares, self.on_screen(self.middles, 1.0, (120, -50)), palette, "dragged")
        self.assertEqual(self.text("#picked h2"), "")  # a drag picks nothing
        self.browser.key("0")
        self.browser.mouse("mouseWheel", 300, 300, deltaX=0, deltaY=-240)
        zoom = math.exp(0.48)
        width, height = self.window()
        moved = [(300 - width / 2) * (1 - zoom), (300 - height / 2) * (1 - zoom)]
        self.expect_colors(self.settled(), shares, self.on_screen(self.middles, zoom, moved), palette, "zoomed")

    def test_a_resized_window_is_filled(self):
        self.open(self.plane)
        self.plain()
        self.settled()
        palette, shares = facts_of(self.plane)["palettes"]["ramp"], self.angles.min(axis=1) / 60.0
        for size in ((1000, 500), (600, 900)):
            self.browser.resize(*size)
            self.browser.wait(lambda: self.browser.evaluate("innerWidth") == size[0], "the window's new size")
            self.browser.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
            self.expect_colors(self.settled(), shares, self.on_screen(self.middles), palette, f"{size}", least=600)

    def test_picked_triangles_have_the_numbers_of_the_file(self):
        self.open(self.plane)
        self.browser.key("+")
        screen = self.on_screen(self.middles, 1.5)
        self.settled()
        for t in (850, 1000, 1090):
            self.browser.click(*screen[t])
            numbers = self.wait_picked(f"Triangle {t + 1}")
            self.assertAlmostEqual(float(numbers["smallest angle"].rstrip("°")), self.angles[t].min(), delta=0.0011)
            self.assertAlmostEqual(float(numbers["largest angle"].rstrip("°")), self.angles[t].max(), delta=0.0011)
            p = self.points[t]
            lengths = sorted(float(numpy.hypot(*(p[i] - p[(i + 1) % 3]))) for i in range(3))
            for told, length in zip(numbers["edges"].split(", "), lengths):
                self.assertAlmostEqual(float(told) / length, 1.0, delta=1e-5)
            area = 0.5 * ((p[1][0] - p[0][0]) * (p[2][1] - p[0][1]) - (p[1][1] - p[0][1]) * (p[2][0] - p[0][0]))
            self.assertAlmostEqual(float(numbers["area"]) / area, 1.0, delta=1e-5)
            mean = -self.places[self.corners[t], 2].mean()
            self.assertAlmostEqual(float(numbers["height, mean"].split()[0]) / mean, 1.0, delta=1e-4)
            nodes = self.browser.evaluate("[...document.querySelectorAll('#picked button')].map(button => button.textContent)")
            self.assertEqual(nodes, [f"node {node + 1}" for node in self.corners[t]])
        self.browser.key("Escape")
        self.browser.wait(lambda: self.text("#picked h2") == "", "nothing to be picked")

    def test_picked_nodes_have_the_numbers_of_the_file(self):
        self.open(self.plane)
        self.settled()
        for node in (300, 511):
            x, y = self.on_screen(self.places[node, :2])
            self.browser.click(x + 1, y - 1)
            numbers = self.wait_picked(f"Node {node + 1}")
            self.assertEqual([float(numbers["x"]), float(numbers["y"])], list(self.places[node, :2]))
            self.assertEqual(numbers["depth"], f"{self.places[node, 2]:g} m")
            around = self.browser.evaluate("[...document.querySelectorAll('#picked button')].map(button => button.textContent)")
            self.assertEqual(around, [f"triangle {t + 1}" for t in numpy.nonzero((self.corners == node).any(axis=1))[0]])

    def test_found_by_number_and_picked_amid_the_window(self):
        self.open(self.earth)
        for node in (0, 700):
            self.browser.key("g", "g")
            self.browser.evaluate(f"document.getElementById('find-text').value = 'node {node + 1}'")
            self.browser.key("Enter", "\r", 13)
            self.wait_picked(f"Node {node + 1}")
            self.browser.evaluate("document.getElementById('picture').focus()")
            self.browser.key("Escape")
            self.browser.wait(lambda: self.text("#picked h2") == "", "nothing to be picked")
            self.browser.key("Enter", "\r", 13)
            numbers = self.wait_picked(f"Node {node + 1}")
            self.assertEqual([float(numbers["longitude"]), float(numbers["latitude"])], list(self.places[node, :2]))
        self.assertEqual(numbers.get("on"), None)
        self.browser.evaluate("page.find('node 1026')")
        self.assertEqual(self.text("#find-error"), "There are nodes 1 to 1,025.")

    def test_lengths_on_earth_are_those_of_the_ellipsoid(self):
        self.open(self.earth)
        self.browser.evaluate("page.find('triangle 901')")
        numbers = self.wait_picked("Triangle 901")
        radius, flattening = 6378137.0, 1 / 298.257223563
        # The ellipsoid's metric at the middle of an edge: the error is of the order of (length / radius) squared.
        lengths = []
        for i in range(3):
            (lon, lat), (to_lon, to_lat) = self.points[900][i], self.points[900][(i + 1) % 3]
            middle = math.radians((lat + to_lat) / 2)
            squares = 1 - flattening * (2 - flattening) * math.sin(middle) ** 2
            east = radius / math.sqrt(squares) * math.cos(middle) * math.radians(to_lon - lon)
            north = radius * (1 - flattening) ** 2 / squares ** 1.5 * math.radians(to_lat - lat)
            lengths.append(math.hypot(east, north))
        for told, length in zip(numbers["edges"].split(", "), sorted(lengths)):
            value, unit = told.split()
            self.assertAlmostEqual(float(value) * {"m": 1, "km": 1000}[unit] / length, 1.0, delta=1e-4)

    def test_histograms_count_every_triangle(self):
        self.open(self.earth)
        for color in facts_of(self.earth)["colors"]:
            self.browser.evaluate(f"page.setColor('{color}')")
            if color == "none":
                self.assertEqual(self.browser.evaluate("document.querySelectorAll('#histogram .bin').length"), 0)
                continue
            counts = self.browser.evaluate("[...document.querySelectorAll('#histogram .bin')].map(bin => Number(bin.dataset.count))")
            self.assertEqual(sum(counts), len(self.corners), color)
        self.open(self.plane)
        tall = "[...document.querySelectorAll('#histogram .bin')].map(bin => Number(bin.getAttribute('height')))"
        heights = self.browser.evaluate(tall)
        self.browser.key("l")
        self.assertGreater(sum(self.browser.evaluate(tall)), sum(heights) + 50)  # log scale raises small counts
        counts = self.browser.evaluate("[...document.querySelectorAll('#histogram .bin')].map(bin => Number(bin.dataset.count))")
        expected, _ = numpy.histogram(numpy.rint(self.angles.min(axis=1) * 1000) / 1000, bins=numpy.arange(61))
        self.assertEqual(counts, list(expected))

    def test_depths_and_sizes_colour_as_the_file_has_them(self):
        self.open(self.plane)
        self.plain()
        facts = facts_of(self.plane)
        heights = -self.places[self.corners, 2].mean(axis=1)
        u, v = self.points[:, 1] - self.points[:, 0], self.points[:, 2] - self.points[:, 0]
        logs = numpy.log(numpy.sqrt((u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]) * 2 / math.sqrt(3)))
        low, high = sorted(logs)[len(logs) // 50], max(logs)
        for color, shares, palette in (
                ("depth", (heights - heights.min()) / (heights.max() - heights.min()), "depth"),
                ("size", (logs - low) / (high - low), "ramp")):
            self.browser.evaluate(f"page.setColor('{color}')")
            self.expect_colors(self.settled(), shares, self.on_screen(self.middles), facts["palettes"][palette], color, tolerance=5, least=1500)
        self.browser.key("C", "C", modifiers=8)
        self.browser.wait(lambda: self.browser.evaluate("document.getElementById('color').value") == "quality", "the colours before")

    def test_the_worst_triangle_among_very_many_equal_ones(self):
        across, grid, html = 90, self.path("regular.14"), self.path("regular.html")
        with open(grid, "w", encoding="utf-8") as file:
            print("regular", f"{2 * across**2} {(across + 1)**2}", sep="\n", file=file)
            for i in range((across + 1)**2):
                x, y = i % (across + 1), i // (across + 1)
                moved = 0.2 if (x, y) == (across - 2, across - 2) else 0.0
                print(i + 1, x + moved, y + moved / 2, 0, file=file)
            for i in range(across**2):
                a = i // across * (across + 1) + i % across + 1
                print(2 * i + 1, 3, a, a + 1, a + across + 2, file=file)
                print(2 * i + 2, 3, a, a + across + 2, a + across + 1, file=file)
            print(0, 0, 0, 0, sep="\n", file=file)
        self.assertEqual(plot(grid, "-o", html).returncode, 0)
        places, corners = read_grid(grid)
        worst = numpy.argsort(angles_of(places[corners][:, :, :2]).min(axis=1), kind="stable")[:3]
        self.open(html)
        for t in worst:
            self.browser.key("w")
            self.wait_picked(f"Triangle {t + 1}")

    def counts(self):
        return self.browser.evaluate("[...document.querySelectorAll('#histogram .bin')].map(bin => Number(bin.dataset.count))")

    def test_triangles_without_an_area_are_shown(self):
        # A node on an edge, and two nodes at one place: sizes and time steps of 0 on a logarithmic scale.
        nodes = [(0, 0), (1, 0), (1, 1), (0, 1), (0.5, 0), (1, 0)]
        triangles = [(1, 2, 3), (1, 3, 4), (1, 5, 2), (2, 6, 3)]
        flat = self.path("flat.14")
        with open(flat, "w", encoding="utf-8") as file:
            print("flat", f"{len(triangles)} {len(nodes)}", sep="\n", file=file)
            for i, node in enumerate(nodes):
                print(i + 1, *node, 5 + i, file=file)
            for i, corners in enumerate(triangles):
                print(i + 1, 3, *corners, file=file)
            print(0, 0, 0, 0, sep="\n", file=file)
        for color in ("size", "timestep"):
            html = self.path(f"flat_{color}.html")
            self.assertEqual(plot(flat, "-o", html, "--color", color).returncode, 0)
            self.open(html)
            self.settled()
            self.assertEqual(sum(self.counts()), 4, color)
            self.assertTrue(self.text("#histogram-text").startswith("least 0"), color)

    def test_halves_of_quadrilaterals_have_its_own_angles(self):
        # A rectangle of 1:3, a parallelogram of 45 degrees, and a triangle.
        nodes = [(0, 0), (3, 0), (3, 1), (0, 1), (4, 2), (1, 2)]
        mesh, html = self.path("quads.2dm"), self.path("quads.html")
        with open(mesh, "w", encoding="utf-8") as file:
            print("MESH2D", "E4Q 1 1 2 3 4 1", "E4Q 2 4 3 5 6 1", "E3T 3 2 5 3 1", sep="\n", file=file)
            for i, (x, y) in enumerate(nodes):
                print("ND", i + 1, x, y, 0, file=file)
        self.assertEqual(plot(mesh, "-o", html, "--color", "quality").returncode, 0)
        self.open(html)
        self.settled()
        qualities = []
        for t, (least, greatest) in enumerate(((90, 90), (90, 90), (45, 135), (45, 135))):
            self.browser.evaluate(f"page.find('triangle {t + 1}')")
            numbers = self.wait_picked(f"Triangle {t + 1}")
            self.assertIn("quadrilateral", numbers["half of"])
            self.assertAlmostEqual(float(numbers["smallest angle"].rstrip("°")), least, delta=0.001)
            self.assertAlmostEqual(float(numbers["largest angle"].rstrip("°")), greatest, delta=0.001)
            qualities.append(float(numbers["quality"]))
        self.assertEqual(qualities, [1.0, 1.0, 0.7071, 0.7071])
        self.browser.evaluate("page.find('triangle 5')")
        self.assertNotIn("half of", self.wait_picked("Triangle 5"))

    def test_depths_that_no_triangle_has_are_unknown(self):
        shore, depths, mesh = self.path("some.geojson"), self.path("some.asc"), self.path("some.nc")
        with open(shore, "w", encoding="utf-8") as file:
            json.dump({"type": "Polygon", "coordinates": [[[0, 0], [0.2, 0], [0.2, 0.2], [0, 0.2], [0, 0]]]}, file)
        with open(depths, "w", encoding="utf-8") as file:  # of one corner
            file.write("ncols 2\nnrows 2\nxllcorner -0.02\nyllcorner -0.02\ncellsize 0.02\n-5 -5\n-5 -5\n")
        made = subprocess.run([PROGRAM, "mesh", shore, "-o", mesh, "--bathymetry", depths, "--depth-fill", "none", "--quiet"],
                              check=False, timeout=300)
        self.assertEqual(made.returncode, 0)
        html = self.path("some.html")
        self.assertEqual(plot(mesh, "-o", html, "--color", "depth").returncode, 0)
        self.open(html)
        self.settled()
        self.assertEqual(self.counts(), [])
        self.assertIn("2 triangles unknown", self.text("#histogram-text"))

    def test_triangles_of_a_pixel_have_their_colours(self):
        grid, html = self.path("many.14"), self.path("many.html")
        write_grid(grid, 400, 240, 5)
        self.assertEqual(plot(grid, "-o", html, "--color", "depth", "--no-edges").returncode, 0)
        self.open(html)
        self.browser.key("b")
        places, corners = read_grid(grid)
        heights = -places[corners, 2].mean(axis=1)
        middles = places[corners][:, :, :2].mean(axis=1)
        some = slice(0, None, 97)
        pixels = self.settled()
        self.assertGreater(self.browser.evaluate("page.mesh.triangles.chunks.length"), 40)
        # The triangle shown at a pixel may be a neighbour: depths differ by less than two steps of the palette.
        self.expect_colors(pixels, ((heights - heights.min()) / (heights.max() - heights.min()))[some], self.on_screen(middles)[some],
                           facts_of(html)["palettes"]["depth"], "small ones", tolerance=8, least=1500)

    def test_themes(self):
        self.open(self.plane)
        light = self.settled()
        self.assertGreater(light[20, 20].min(), 200)
        self.browser.key("t")
        dark = self.settled()
        self.browser.screenshot(os.path.join(PICTURES, "page_dark.png"))
        self.assertLess(dark[20, 20].max(), 90)
        self.assertLess(dark[400, 1270].max(), 90)  # the panel
        self.assertGreater(light[400, 1270].min(), 200)
        self.browser.prefer("dark")
        self.open(self.plane)
        self.assertLess(self.settled()[20, 20].max(), 90)

    def test_bad_triangles_are_red(self):
        html = self.path("bad.html")
        bound = float(numpy.sort(self.angles.min(axis=1))[40]) + 0.05
        self.assertEqual(plot(self.grid, "-o", html, "--min-angle", str(bound)).returncode, 0)
        self.open(html)
        self.plain()
        pixels, screen = self.settled(), self.on_screen(self.middles)
        for t, least in enumerate(self.angles.min(axis=1)):
            x, y = screen[t]
            red = abs(pixels[int(y), int(x)] - [224, 26, 26]).max() < 5
            if abs(least - bound) > 0.02:
                self.assertEqual(red, least < bound, f"triangle {t}")
        self.browser.key("w")
        self.wait_picked(f"Triangle {int(self.angles.min(axis=1).argmin()) + 1}")

    def test_a_globe_turns(self):
        mesh, html = self.path("globe.nc"), self.path("globe.html")
        made = subprocess.run([PROGRAM, "mesh", "--domain", "globe", "--size", "400000", "-o", mesh, "--quiet"], check=False, timeout=300)
        self.assertEqual(made.returncode, 0)
        self.assertEqual(plot(mesh, "-o", html, "--view", "orthographic=20,30", "--color", "none", "--no-edges").returncode, 0)
        self.open(html)
        before = self.settled()
        self.browser.screenshot(os.path.join(PICTURES, "page_globe.png"))
        width, height = (int(size) for size in self.window())
        radius = int(0.95 * min(width, height) / 2)
        water = numpy.array([221, 236, 246])
        for x, y in ((0, 0), (0.9, 0), (-0.9, 0), (0, 0.9), (0.6, -0.6)):
            seen = before[height // 2 - int(y * radius), width // 2 + int(x * radius)]
            self.assertLess(abs(seen - water).max(), 4, (x, y))
        self.assertGreater(before[height // 2 - radius + 5, width // 2 - radius + 5].min(), 250)  # outside the globe
        self.browser.mouse("mouseMoved", width / 2, height / 2)
        self.browser.wait(lambda: self.text("#pointer") != "", "a place under the mouse")
        lon, lat = map(float, self.text("#pointer").split(", "))
        self.assertAlmostEqual(lon, 20.0, delta=0.2)
        self.assertAlmostEqual(lat, 30.0, delta=0.4)
        self.browser.key("e")
        self.browser.drag((width / 2, height / 2), (width / 2 + radius / 2, height / 2))
        self.settled()
        self.assertLess(self.browser.evaluate("page.view.middle[0]"), -5.0)
        self.assertEqual(plot(mesh, "-o", html, "--view", "natural-earth", "--overwrite").returncode, 2)

    def test_a_lake_is_shown_whole(self):
        mesh, html = self.path("lake.nc"), self.path("lake.html")
        made = subprocess.run([PROGRAM, "mesh", os.path.join(DATA, "lake_superior.geojson"), "-o", mesh, "--quiet"], check=False, timeout=300)
        self.assertEqual(made.returncode, 0)
        self.assertEqual(plot(mesh, "-o", html).returncode, 0)
        self.open(html)
        whole = self.settled()
        self.browser.key("w")
        self.browser.wait(lambda: self.text("#picked h2") != "", "the worst triangle")
        self.browser.key("0")
        self.settled()
        self.browser.screenshot(os.path.join(PICTURES, "page_lake.png"))
        # The lake fills the window from west to east, and covers about a third of it.
        width, height = (int(size) for size in self.window())
        water = abs(whole[:height, :width] - [244, 242, 238]).max(axis=2) > 12
        columns = numpy.nonzero(water[:, :900].any(axis=0))[0]
        self.assertLess(columns[0], 0.05 * width)
        self.assertAlmostEqual(water[:, :900].mean(), 0.3, delta=0.1)

    def test_help_lists_the_keys(self):
        self.open(self.plane)
        self.assertFalse(self.browser.evaluate("document.getElementById('help').open"))
        self.browser.key("?", "?")
        self.browser.wait(lambda: self.browser.evaluate("document.getElementById('help').open"), "help")
        keys = set(self.browser.evaluate("[...document.querySelectorAll('#help kbd')].map(key => key.textContent)"))
        self.assertLessEqual({"+", "-", "0", "Enter", "C", "E", "B", "L", "T", "W", "G", "F", "P", "?"}, keys)
        self.browser.key("Escape", code=27)
        self.browser.wait(lambda: not self.browser.evaluate("document.getElementById('help').open"), "help to close")

    def test_a_page_cut_short_says_so(self):
        broken = self.path("broken.html")
        with open(self.plane, encoding="utf-8") as file:
            text = file.read()
        start = text.index('id="array-corners">') + len('id="array-corners">')
        with open(broken, "w", encoding="utf-8") as file:
            file.write(text[:start] + text[start + 400:])
        self.browser.open(broken)
        self.browser.wait(lambda: self.browser.evaluate("document.documentElement?.dataset.failed !== undefined"), "an error")
        self.assertIn("cut short or changed", self.said())
        self.browser.events.clear()  # the error is expected

    def test_without_webgl_it_says_what_to_do(self):
        with browser.Browser(WIDTH, HEIGHT, webgl=False) as other:
            other.open(self.plane)
            other.wait(lambda: other.evaluate("document.documentElement?.dataset.failed !== undefined"), "an error")
            said = other.evaluate("document.getElementById('message').textContent")
            self.assertIn("WebGL 2", said)
            self.assertIn("coastmesh plot MESH -o mesh.png", said)

    def test_options_of_pictures_are_refused(self):
        for option in (["--size", "300"], ["--bbox=-5,43,-4,44"], ["--degrees"]):
            run = plot(self.grid, "-o", self.path("refused.html"), *option)
            self.assertEqual(run.returncode, 2, option)
            self.assertIn("is for pictures", run.stderr)
            self.assertFalse(os.path.exists(self.path("refused.html")))


if __name__ == "__main__":
    if not browser.program():
        print("skipped: no chromium here")
        sys.exit(77)
    del sys.argv[1:4]
    unittest.main(verbosity=2)
