"""Validates the datapackage.json of every result folder against the schema, and the schema against broken ones.

usage: datapackage.py SCHEMA FOLDERS
"""
import copy
import json
import pathlib
import sys

try:
    import jsonschema
except ImportError:
    print("skipped: the Python package jsonschema is not installed")
    sys.exit(0)


def faults(package, schema):
    return [f"{'/'.join(map(str, e.path))}: {e.message[:200]}" for e in jsonschema.Draft4Validator(schema).iter_errors(package)]


def broken(package):
    """Copies of a good package, each with one fault."""
    def without(*path):
        out = copy.deepcopy(package)
        inner = out
        for key in path[:-1]:
            inner = inner[key]
        del inner[path[-1]]
        return out

    def changed(value, *path):
        out = without(*path)
        inner = out
        for key in path[:-1]:
            inner = inner[key]
        if isinstance(inner, list):
            inner.insert(path[-1], value)
        else:
            inner[path[-1]] = value
        return out

    resource = ("resources", 0)
    field = (*resource, "schema", "fields", 0)
    yield "no profile", without("profile")
    yield "upper case in a name", changed("Thin Wall", "name")
    yield "no resource", changed([], "resources")
    yield "a resource without a path", without(*resource, "path")
    yield "a path that leaves the folder", changed("../data/cells.csv", *resource, "path")
    yield "no schema", without(*resource, "schema")
    yield "no fields", changed([], *resource, "schema", "fields")
    yield "a field without a name", without(*field, "name")
    yield "an unknown type", changed("float", *field, "type")
    yield "a number without a unit", changed({"name": "x", "type": "number", "description": "y"}, *field)


def main(schema_file, folders):
    schema = json.loads(pathlib.Path(schema_file).read_text())
    jsonschema.Draft4Validator.check_schema(schema)
    files = sorted(pathlib.Path(folders).glob("*/datapackage.json"))
    if not files:
        sys.exit(f"{folders}: no datapackage.json was found")
    bad = 0
    for file in files:
        for fault in faults(json.loads(file.read_text()), schema):
            print(f"{file}: {fault}")
            bad += 1
    for what, package in broken(json.loads(files[0].read_text())):
        if not faults(package, schema):
            print(f"the schema lets pass: {what}")
            bad += 1
    print(f"{len(files)} packages, {bad} faults")
    sys.exit(1 if bad else 0)


main(*sys.argv[1:])
