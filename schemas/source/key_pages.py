"""The pages that list every key of files and documents, and every column of tables."""

HEAD = "Written by `scripts/schemas` from `schemas/source`, as the schemas are ([how to use them](schemas.md)).\n"


def cell(text):
    return text.replace("|", "\\|").replace("\n", " ")


def kind_of(schema):
    """In few words what a value is."""
    if "$ref" in schema:
        return {"errorShape": "table ([term](#terms-of-errors))", "errorEntry": "[error](#terms-of-errors)",
                "errorFactor": "table", "command": "table (the same again)"}.get(schema["$ref"].split("/")[-1], "table")
    if "const" in schema:
        return f"`{schema['const']}`" if isinstance(schema["const"], str) else str(schema["const"]).lower()
    if "x-unit" in schema:
        return "length" if schema["x-unit"] == "mm" else "angle"
    if "enum" in schema:
        return " ".join(f"`{word}`" for word in schema["enum"])
    if "anyOf" in schema and "type" not in schema:
        kinds = list(dict.fromkeys(kind_of(each) for each in schema["anyOf"]))
        return " or ".join(kinds)
    kind = schema.get("type", "any")
    if kind == ["string", "number"] and schema.get("maximum") == 0:
        return "text with its unit"
    if isinstance(kind, list):
        return " or ".join(kind_of({**schema, "type": each}) for each in kind)
    if kind == "array":
        items = schema.get("items", {})
        size = schema.get("minItems") if schema.get("minItems") == schema.get("maxItems") else None
        of = {"number": "numbers", "string": "texts", "integer": "whole numbers", "object": "tables"}.get(
            items.get("type") if isinstance(items.get("type"), str) else "", "lists" if items.get("type") == "array"
            else "values")
        return f"{size} {of}" if size else f"list of {of}"
    return {"string": "text", "boolean": "true or false", "integer": "whole number", "object": "table",
            "null": "null"}.get(kind, kind)


def nested_of(schema):
    """The tables within a value: (suffix of the path, table)."""
    found = []
    if schema.get("type") == "object" or schema.get("type") == ["object", "null"]:
        found.append(("", schema))
    if "items" in schema:
        found += [("[]" + path, table) for path, table in nested_of(schema["items"])]
    for each in schema.get("anyOf", []):
        if isinstance(each, dict):
            found += nested_of(each)
    return found


NEEDED, OPTIONAL = ("**needed**", ""), ("", "*not always*")  # of a key that is required, of one that is not


def about(schema, required, marks):
    text = schema.get("description", "")
    if "default" in schema:
        default = schema["default"]
        shown = str(default).lower() if isinstance(default, bool) else str(default)
        text += f" (default {shown})"
    mark = marks[0] if required else marks[1]
    return f"{text}{' ' if text and mark else ''}{mark}"


def rows_of(table, marks, path=""):
    """(path, kind, meaning) of every key, tables within tables after their own line."""
    rows = []
    required = table.get("required", [])
    for name, schema in table.get("properties", {}).items():
        here = f"{path}{name}"
        rows.append((here, kind_of(schema), about(schema, name in required, marks)))
        for suffix, inner in nested_of(schema):
            rows += rows_of(inner, marks, f"{here}{suffix}.")
    for pattern in (*table.get("patternProperties", {}).values(), table.get("additionalProperties")):
        if not isinstance(pattern, dict) or not pattern:
            continue
        here = f"{path}NAME"
        rows.append((here, kind_of(pattern), pattern.get("description", "")))
        for suffix, inner in nested_of(pattern):
            rows += rows_of(inner, marks, f"{here}{suffix}.")
    return rows


def keys_table(table, marks=NEEDED, head="key"):
    if table.get("type") == "array":
        return keys_table(table["items"], marks, head)
    lines = [f"| {head} | value | meaning |", "| --- | --- | --- |"]
    lines += [f"| `{path}` | {cell(kind)} | {cell(meaning)} |" for path, kind, meaning in rows_of(table, marks)]
    return "\n".join(lines) + "\n"


def files_page(schemas):
    text = "# Keys of files\n\nEvery key of every TOML file that Frustum reads. " + HEAD + """
A length is a number in mm, or a text with its unit (`"10 um"`); an angle a number in degrees, or a text (`"30 urad"`). `NAME`
is a name of your own choice, or one of those that the line says; `[]` each of a list of tables. Files are named by paths from the
folder of the file that names them. An unknown key is an error that suggests the nearest known one.
"""
    for schema in schemas:
        files = f" (`{schema.files}`)" if schema.files else ""
        text += f"\n## {schema.title}\n\n{schema.body['description']}{files}. Schema: "
        text += f"`schemas/files/{schema.name}.schema.json`, version {schema.version}.\n\n" + keys_table(schema.body)
    shapes = next(schema for schema in schemas if schema.name == "errors").defs
    text += "\n## Terms of errors\n\nAn error is a text as on the command line (`\"linear 10um\"`), a table of these keys, or a "
    text += "list of such tables, which are added ([error names and sign conventions](errors.md)).\n\n"
    return text + keys_table(shapes["errorShape"]) + "\n`times`:\n\n" + keys_table(shapes["errorFactor"])


def results_page(schemas, tables):
    text = "# Keys of documents and columns of tables\n\nEvery key of every JSON document that Frustum writes, and every "
    text += "column of its CSV files. " + HEAD + """
Later versions add keys and columns; none is renamed. Units are in the key, or beside the value in `unit`. `NAME` is a name that
depends on the machine, plan or study; `[]` each of a list; *not always*: a document may lack it. A document names its form in `schema` and the program in `version`; the
lists of `machines --json` and `motion names --json`, the lines of `parse --canon`, baselines and the files of the benchmark have
neither. SARIF and QIF have public schemas.
"""
    for schema in schemas:
        form = f"`frustum/{schema.name}/1`, " if "schema" in schema.body.get("properties", {}) else ""
        text += f"\n## {schema.title}\n\n{schema.body['description']}. Schema: {form}"
        text += f"`schemas/documents/{schema.name}.schema.json`, version {schema.version}.\n\n" + keys_table(schema.body, OPTIONAL)
        for name, definition in schema.defs.items():
            text += f"\n`{name}`:\n\n" + keys_table(definition, OPTIONAL)
    text += "\n## Tables\n\nCSV, as metadata of CSV on the Web in `schemas/tables`. Lines that begin with `#` are comments.\n"
    for table in tables:
        text += f"\n### {table.title}\n\n{table.about}. `schemas/tables/{table.name}.csv-metadata.json`, version "
        text += f"{table.version}.\n\n| column | value | unit | meaning |\n| --- | --- | --- | --- |\n"
        for each in table.columns:
            needed = " **needed**" if each["required"] else ""
            several = ", any number of such columns" if "urn:frustum:columnPattern" in each else ""
            text += (f"| `{each['titles']}` | {each['datatype']} | {each.get('schema:unitText', '')} | "
                     f"{cell(each['dc:description'])}{several}{needed} |\n")
    return text
