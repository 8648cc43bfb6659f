#!/usr/bin/env python3
"""FESOM2's dist_N, read as FESOM2 reads it and put to use: every process gets from the others just what it needs.

usage: fesom_partition.py --program coastmesh --lake data/lake_superior.geojson

Knows of the files only what FESOM2 does: lists are records of numbers, read with Fortran's list-directed input. The
halos, the numbers of edges and the exchange are worked out here anew, from nod2d.out and elem2d.out alone.
"""
import argparse
import os
import subprocess
import tempfile
import unittest


class Records:
    """A file as Fortran's `read(unit, *)` takes it: each read begins a line, goes on over as many as it needs, and leaves
    the rest of the last one."""

    def __init__(self, path):
        with open(path, encoding="ascii") as file:
            self.lines = file.read().splitlines()
        self.at = 0

    def read(self, count=None):
        """So many integers; one where none is said."""
        values = []
        first = True
        while first or len(values) < (1 if count is None else count):
            assert self.at < len(self.lines), "the file ends before its list does"
            values += [int(word) for word in self.lines[self.at].split()]
            self.at += 1
            first = False
        assert len(values) == (1 if count is None else count), "a line holds more than its list"
        return values[0] if count is None else values

    def end(self):
        assert self.at == len(self.lines), "the file goes on"


class Process:
    """What one process reads; global numbers from 1."""

    def __init__(self, folder, rank):
        file = Records(os.path.join(folder, f"my_list{rank:05d}.out"))
        assert file.read() == rank
        self.own_nodes, self.halo_nodes = file.read(), file.read()
        self.nodes = file.read(self.own_nodes + self.halo_nodes)
        self.own_elements, self.beside, self.beyond = file.read(), file.read(), file.read()
        self.elements = file.read(self.own_elements + self.beside + self.beyond)
        self.own_edges, self.outer_edges = file.read(), file.read()
        self.edges = file.read(self.own_edges + self.outer_edges)
        file.end()
        file = Records(os.path.join(folder, f"com_info{rank:05d}.out"))
        assert file.read() == rank
        sizes = [self.halo_nodes, self.beside, self.beside + self.beyond]
        self.exchanges = [(self.half(file, size), self.half(file, None)) for size in sizes]
        file.end()

    @staticmethod
    def half(file, size):
        """Peers, and the local numbers that go to or come from each."""
        peers = file.read(file.read())
        begins = file.read(len(peers) + 1)
        items = file.read(begins[-1] - 1)
        assert begins[0] == 1 and begins == sorted(begins) and (size is None or len(items) == size)
        assert peers == sorted(set(peers)) and len(peers) <= 32
        return {peer: items[begins[i] - 1:begins[i + 1] - 1] for i, peer in enumerate(peers)}


def read_mesh(folder):
    with open(os.path.join(folder, "nod2d.out"), encoding="ascii") as file:
        count = int(file.readline())
        places = [tuple(map(float, file.readline().split()[1:3])) for _ in range(count)]
    with open(os.path.join(folder, "elem2d.out"), encoding="ascii") as file:
        count = int(file.readline())
        elements = [tuple(map(int, file.readline().split()[:3])) for _ in range(count)]
    return places, elements


def turned(places, element):
    """FESOM2 has elements clockwise in the plane of longitudes and latitudes: others get their second and third corner
    exchanged."""
    a, b, c = (places[node - 1] for node in element)
    area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (element[0], element[2], element[1]) if area > 0 else element


def edges_of(places, elements):
    """The edges in the order of FESOM2's edges.out: each node's neighbours as its elements name them first, those with a
    greater number; edges between two elements first, then those of one."""
    elements = [turned(places, element) for element in elements]
    round_node = {}
    for number, element in enumerate(elements):
        for node in element:
            round_node.setdefault(node, []).append(number)
    inside, outside = [], []
    for node in range(1, len(places) + 1):
        neighbours = dict.fromkeys(n for e in round_node[node] for n in elements[e] if n != node)
        for other in neighbours:
            if other > node:
                both = [e for e in round_node[node] if other in elements[e]]
                (inside if len(both) == 2 else outside).append((node, other))
    return inside + outside


class FesomPartition(unittest.TestCase):
    def deal(self, parts, *options):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        path = folder.name
        os.mkdir(os.path.join(path, f"dist_{parts}"))
        run = subprocess.run([PROGRAM, "mesh", LAKE, *options, "--bathymetry", self.depths(path), "--partition", str(parts), "-o",
                              os.path.join(path, "nod2d.out"), "-o", os.path.join(path, f"dist_{parts}", "rpart.out"), "--quiet"],
                             capture_output=True, text=True, check=False)
        self.assertEqual(run.returncode, 0, run.stderr)
        return path, os.path.join(path, f"dist_{parts}")

    @staticmethod
    def depths(folder):
        path = os.path.join(folder, "depths.asc")
        with open(path, "w", encoding="ascii") as file:
            file.write("ncols 2\nnrows 2\nxllcorner -93\nyllcorner 45\ncellsize 5\nNODATA_value -9999\n-50 -50\n-50 -50\n")
        return path

    def check(self, parts, *options):
        path, folder = self.deal(parts, *options)
        places, elements = read_mesh(path)
        edges = edges_of(places, elements)
        self.assertEqual(sorted(os.listdir(folder)),
                         sorted(["rpart.out"] + [f"{kind}{rank:05d}.out" for rank in range(parts) for kind in ("my_list", "com_info")]))
        processes = [Process(folder, rank) for rank in range(parts)]
        part_of = {node: rank for rank, p in enumerate(processes) for node in p.nodes[:p.own_nodes]}
        self.assertEqual(sorted(part_of), list(range(1, len(places) + 1)))

        # rpart.out: nodes are numbered process by process.
        file = Records(os.path.join(folder, "rpart.out"))
        self.assertEqual(file.read(), parts)
        self.assertEqual(file.read(parts), [p.own_nodes for p in processes])
        numbers = [file.read() for _ in places]
        file.end()
        in_order = [node for p in processes for node in p.nodes[:p.own_nodes]]
        self.assertEqual([numbers[node - 1] for node in in_order], list(range(1, len(places) + 1)))

        owners = [{part_of[node] for node in element} for element in elements]
        round_node = {}
        for number, element in enumerate(elements, 1):
            for node in element:
                round_node.setdefault(node, set()).add(number)
        for rank, p in enumerate(processes):
            self.assertGreater(p.own_nodes, 0)
            own = set(p.nodes[:p.own_nodes])
            mine = [number for number, of in enumerate(owners, 1) if rank in of]
            self.assertEqual(p.elements[:p.own_elements], mine)
            self.assertEqual(set(p.nodes[p.own_nodes:]), {n for e in mine for n in elements[e - 1]} - own)
            touching = {e for number in mine for node in elements[number - 1] for e in round_node[node]} - set(mine)
            beside = {e for e in touching
                      if any(len(set(elements[e - 1]) & set(elements[other - 1])) == 2
                             for node in elements[e - 1] for other in round_node[node] if rank in owners[other - 1])}
            self.assertEqual(set(p.elements[p.own_elements:p.own_elements + p.beside]), beside)
            self.assertEqual(set(p.elements[p.own_elements + p.beside:]), touching - beside)
            self.assertEqual(len(p.elements), len(set(p.elements)))
            self.assertEqual(p.edges[:p.own_edges], [i for i, edge in enumerate(edges, 1) if own & set(edge)])
            outer = {i for i, edge in enumerate(edges, 1)
                     if not own & set(edge) and any(set(edge) <= set(elements[e - 1]) for e in round_node[edge[0]] & set(mine))}
            self.assertEqual(set(p.edges[p.own_edges:]), outer)
            self.assertEqual(len(p.edges), len(set(p.edges)))

        # The exchange itself: every halo entry receives the number of its own node or element.
        for kind in range(3):
            for rank, p in enumerate(processes):
                here = p.nodes if kind == 0 else p.elements
                own = p.own_nodes if kind == 0 else p.own_elements
                arrived = {}
                for peer, places_here in p.exchanges[kind][0].items():
                    there = processes[peer]
                    sent = [(there.nodes if kind == 0 else there.elements)[i - 1] for i in there.exchanges[kind][1][rank]]
                    self.assertEqual(len(sent), len(places_here))
                    self.assertTrue(all(i <= (there.own_nodes if kind == 0 else there.own_elements)
                                        for i in there.exchanges[kind][1][rank]), "sends what is not its own")
                    arrived.update(zip(places_here, sent))
                    if kind == 0:
                        self.assertEqual({part_of[node] for node in sent}, {peer})
                wanted = range(own + 1, own + (p.halo_nodes, p.beside, p.beside + p.beyond)[kind] + 1)
                self.assertEqual(arrived, {i: here[i - 1] for i in wanted})
                # No process sends without a receiver.
                for peer in p.exchanges[kind][1]:
                    self.assertIn(rank, processes[peer].exchanges[kind][0])
        return processes

    def test_of_four(self):
        processes = self.check(4)
        self.assertTrue(any(p.beyond for p in processes))
        self.assertTrue(any(p.outer_edges for p in processes))

    def test_of_many_small_ones(self):
        self.check(23, "--size-max", "12000")

    def test_of_one(self):
        self.assertEqual(self.check(1)[0].halo_nodes, 0)

    def test_the_folder_has_to_be_fesom2s(self):
        with tempfile.TemporaryDirectory() as folder:
            mesh = os.path.join(folder, "nod2d.out")
            depths = self.depths(folder)
            subprocess.run([PROGRAM, "mesh", LAKE, "--bathymetry", depths, "-o", mesh, "--quiet"], check=True)
            for name, parts, why in (("dist_4", "5", "for 4 processes, not for 5"), ("four", "4", "dist_N"), ("dist_x", "4", "dist_N"),
                                     ("dist_0", "4", "dist_N")):
                os.mkdir(os.path.join(folder, name))
                run = subprocess.run([PROGRAM, "partition", mesh, parts, "-o", os.path.join(folder, name, "rpart.out")],
                                     capture_output=True, text=True, check=False)
                self.assertEqual(run.returncode, 2, run.stderr)
                self.assertIn(why, run.stderr)
                self.assertEqual(os.listdir(os.path.join(folder, name)), [])
            # A mesh read from a file is divided like one just made.
            os.mkdir(os.path.join(folder, "dist_3"))
            subprocess.run([PROGRAM, "partition", mesh, "3", "-o", os.path.join(folder, "dist_3", "rpart.out"), "--quiet"], check=True)
            _, made = self.deal(3)
            for name in os.listdir(made):
                with open(os.path.join(made, name), "rb") as a, open(os.path.join(folder, "dist_3", name), "rb") as b:
                    self.assertEqual(a.read(), b.read(), name)


parser = argparse.ArgumentParser()
parser.add_argument("--program", required=True)
parser.add_argument("--lake", required=True)
asked, rest = parser.parse_known_args()
PROGRAM, LAKE = os.path.abspath(asked.program), os.path.abspath(asked.lake)

if __name__ == "__main__":
    unittest.main(argv=["fesom_partition.py", *rest], verbosity=2)
