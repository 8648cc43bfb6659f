#!/usr/bin/python3
"""Reports of many kinds of runs against docs/report.schema.json. The schema lets keys be added, as a newer version may; here
every object is closed first, so that a key which the schema does not know fails.

usage: report_schema_test.py PROGRAM
"""
import copy
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import jsonschema
except ImportError:
    print("skipped: there is no python3-jsonschema")
    sys.exit(77)

PROGRAM = os.path.abspath(sys.argv[1])
SOURCES = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(SOURCES / "tests/golden"))
import inputs  # noqa: E402  (found by the line above)

SCHEMA = json.loads((SOURCES / "docs/report.schema.json").read_text(encoding="utf-8"))
SEA = ("mesh made/hispaniola.geojson --crs plane --domain outside --bbox=-182500,1823500,657500,2321200 "
       "--bathymetry made/sea_bed.asc --size-shore 8000 --size-max 40000 ")
# Kind of report, exit code, command. The order matters where commands share files.
RUNS = {
    "lake": ("mesh_report", 0, "mesh data/lake_superior.geojson -o lake.nc"),
    "plane": ("mesh_report", 1, "mesh made/comb.poly -o comb.node --min-angle 44"),
    "lakes": ("mesh_report", 0, "mesh data/samples/finnish_lakes.geojson -o lakes.gpkg"),
    "sea": ("mesh_report", 0, SEA + "--attribute manning=made/sea_bed.asc --size-min 4000 --coast follow --target adcirc "
            "--open-deeper 200 --time-step 120 "
            "--partition 4 -o sea.nc -o sea.14 -o partmesh.txt"),
    "short": ("mesh_report", 1, SEA + "--size-min 9000 --time-step 900 -o short.nc"),
    "no depths": ("mesh_report", 1, "mesh data/lake_superior.geojson --bathymetry elsewhere.asc --min-angle 44 -o dry.nc"),
    "plain": ("mesh_report", 0, "mesh data/lake_superior.geojson --bathymetry plain.asc -o plain.nc"),
    "mended": ("mesh_report", 0, "mesh made/touching.geojson --crs plane --target schism -o mended.gr3"),
    "left": ("mesh_report", 1, "mesh made/fan.poly --min-angle 0 --no-coarsen --target mpas -o left.nc"),
    "globe": ("mesh_report", 0, "mesh --domain globe --size 800000 -o globe.nc"),
    "refused": ("mesh_report", 1, "mesh made/touching.geojson --size 1 --max-vertices 1000 -o none.nc"),
    "shard": ("mesh_report", 0, "mesh data/samples/finnish_lakes.geojson --shard 1/1 -o one.shard"),
    "gathered": ("mesh_report", 0, "gather one.shard -o gathered.nc"),
    "each": ("per_feature_report", 0, "mesh data/samples/finnish_lakes.geojson --per-feature -o lake-{}.nc"),
    "some": ("per_feature_report", 0, "mesh data/samples/finnish_lakes.geojson --per-feature --shard 1/2 --skip-existing "
             "-o lake-{}.nc"),
    "clean": ("clean_report", 0, "clean data/samples/belgium_luxembourg.geojson -o clean.gpkg"),
    "partition": ("partition_report", 0, "partition lake.nc 4 -o lake.prop -o parts/partmesh.txt"),
}


def closed(schema):
    """The same, without room for keys that it does not name."""
    if isinstance(schema, list):
        return [closed(part) for part in schema]
    if not isinstance(schema, dict):
        return schema
    parts = {key: closed(part) for key, part in schema.items()}
    if schema.get("type") == "object" and "properties" in schema:
        parts["additionalProperties"] = False
    return parts


def validator(kind):
    """Of one kind of report, so that what is wrong has one place."""
    return jsonschema.Draft202012Validator({**closed(SCHEMA), "anyOf": [{"$ref": f"#/$defs/{kind}"}]})


def objects(value):
    """All objects in a report, with where they are."""
    if isinstance(value, dict):
        yield value
    for part in value.values() if isinstance(value, dict) else value if isinstance(value, list) else ():
        yield from objects(part)


def first_of_lists(value):
    if isinstance(value, dict):
        return {key: first_of_lists(part) for key, part in value.items()}
    return [first_of_lists(part) for part in value[:3]] if isinstance(value, list) and value and isinstance(value[0], dict) else value


def named_keys(schema, path=()):
    """The keys that the schema names, by where they stand in a report."""
    if "$ref" in schema:
        yield from named_keys(SCHEMA["$defs"][schema["$ref"].rsplit("/", 1)[1]], path)
    for key, part in schema.get("properties", {}).items():
        yield (*path, key)
        yield from named_keys(part, (*path, key))
    for part in schema.get("anyOf", []):
        yield from named_keys(part, path)
    if isinstance(schema.get("items"), dict):
        yield from named_keys(schema["items"], (*path, "[]"))


def keys_of(report, path=()):
    if isinstance(report, dict):
        for key, part in report.items():
            yield (*path, key)
            yield from keys_of(part, (*path, key))
    elif isinstance(report, list):
        for part in report:
            yield from keys_of(part, (*path, "[]"))


class ReportSchemaTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        path = pathlib.Path(folder.name)
        (path / "data").symlink_to(SOURCES / "data")
        for sub in ("made", "parts"):
            (path / sub).mkdir()
        inputs.make(path / "made")
        inputs.write_grid(path / "elsewhere.asc", (10.0, 10.0), 0.1, 4, 4, lambda x, y: -10.0)
        # Land in the west.
        inputs.write_grid(path / "plain.asc", (-93.0, 46.0), 0.1, 100, 40, lambda x, y: -20.0 if x > 0.3 else 4.0)
        cls.reports = {}
        for name, (kind, code, command) in RUNS.items():
            report = path / f"{name}.json"
            run = subprocess.run([PROGRAM, *command.split(), "--quiet", "--report", str(report)], cwd=path,
                                 capture_output=True, text=True, check=False)
            assert run.returncode == code, (name, run.returncode, run.stderr)
            cls.reports[name] = (kind, json.loads(report.read_text(encoding="utf-8")))

    def test_the_schema_is_one(self):
        jsonschema.Draft202012Validator.check_schema(SCHEMA)

    def test_reports_are_as_it_says(self):
        whole = jsonschema.Draft202012Validator(SCHEMA)
        for name, (kind, report) in self.reports.items():
            with self.subTest(name):
                errors = [f"{'/'.join(map(str, error.absolute_path))}: {error.message[:300]}"
                          for error in validator(kind).iter_errors(report)]
                self.assertEqual(errors, [], "docs/report.schema.json and apps/README.md have to tell of it")
                self.assertTrue(whole.is_valid(report))

    def test_a_key_that_is_not_in_it_fails_wherever_it_stands(self):
        kind, report = self.reports["sea"]
        check = validator(kind)
        # The first three items of a list represent the rest.
        report = first_of_lists(report)
        for number in range(len(list(objects(report)))):
            changed = copy.deepcopy(report)
            place = list(objects(changed))[number]
            if place is changed["input"]["projections"]:  # its keys are data
                continue
            place["unheard_of"] = 1
            self.assertFalse(check.is_valid(changed), sorted(place))

    def test_a_key_that_is_missing_fails(self):
        for kind, report in self.reports.values():
            for key in report:
                self.assertFalse(validator(kind).is_valid({k: v for k, v in report.items() if k != key}), key)

    def test_every_key_that_it_names_is_seen_in_a_run(self):
        # Triangles turned over on the ground occur in no short run; several ranks are tested in tests/cluster.
        exempt = (("mesh", "turned", "places"), ("cluster", "by_rank", "[]"))
        for kind in ("mesh_report", "per_feature_report", "clean_report", "partition_report"):
            seen = {key for of_kind, report in self.reports.values() if of_kind == kind for key in keys_of(report)}
            unseen = set(named_keys(SCHEMA["$defs"][kind])) - seen
            self.assertEqual({key for key in unseen if key[:3] not in exempt}, set(), kind)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[2:], verbosity=2)
