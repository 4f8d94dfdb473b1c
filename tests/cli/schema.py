"""Validate JSON values against docs/report.schema.json: schema.py SCHEMA NAME FILE, where NAME is one of its $defs. The file may
hold several values, one after the other. Knows the keywords that the schema uses, and refuses a schema with others."""
import json
import re
import sys

KNOWN = {"type", "properties", "required", "additionalProperties", "items", "minItems", "maxItems", "enum", "const", "pattern",
         "description"}
TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "null": type(None), "number": (int, float), "integer": int}


def is_type(value, name):
    return isinstance(value, TYPES[name]) and (name == "boolean" or not isinstance(value, bool))


def faults(value, schema, where):
    unknown = set(schema) - KNOWN
    if unknown:
        yield "%s: the schema says %s, which is not checked" % (where, unknown)
    names = schema.get("type", [])
    names = [names] if isinstance(names, str) else names
    if names and not any(is_type(value, n) for n in names):
        yield "%s is %r, not %s" % (where, value, " or ".join(names))
        return
    if "const" in schema and value != schema["const"]:
        yield "%s is %r, not %r" % (where, value, schema["const"])
    if "enum" in schema and value not in schema["enum"]:
        yield "%s is %r, not one of %s" % (where, value, schema["enum"])
    if "pattern" in schema and not re.search(schema["pattern"], value):
        yield "%s is %r, not like %s" % (where, value, schema["pattern"])
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            yield "%s has %d items" % (where, len(value))
        for k, item in enumerate(value):
            yield from faults(item, schema.get("items", {}), "%s[%d]" % (where, k))
    if isinstance(value, dict):
        known, more = schema.get("properties", {}), schema.get("additionalProperties", True)
        for name in schema.get("required", []):
            if name not in value:
                yield "%s lacks %s" % (where, name)
        for name, item in value.items():
            if name in known or isinstance(more, dict):
                yield from faults(item, known.get(name, more), "%s.%s" % (where, name))
            elif not more:
                yield "%s has %s, which the schema does not know" % (where, name)


schema = json.load(open(sys.argv[1]))["$defs"][sys.argv[2]]
text, at, count, bad = open(sys.argv[3]).read(), 0, 0, 0
while text[at:].strip():
    at += len(text[at:]) - len(text[at:].lstrip())
    value, at = json.JSONDecoder(parse_constant=lambda c: sys.exit("%s is not JSON" % c)).raw_decode(text, at)
    count += 1
    for fault in faults(value, schema, sys.argv[2]):
        print(fault)
        bad += 1
sys.exit(1 if bad or not count else 0)
