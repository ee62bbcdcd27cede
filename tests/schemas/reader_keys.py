"""Which keys the readers of TOML files ask for, from their sources: every literal key of a TomlTable's questions,
and the lists of keys that they go through."""

import re
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

QUESTIONS = ("text|text_or|choice|choice_or|number|number_or|integer|integer_or|boolean_or|length|length_or|angle|"
             "angle_or|quantity|vector|vector_or|numbers|rows|texts_or|table|table_if|tables|is_table|is_array|"
             "is_number|file_path|has")

# `table.length("diameter", ..)`, `root->has("tool")`, and functions of the readers that take table and key.
ASKED = re.compile(rf"(?:\.|->)(?:{QUESTIONS})\(\s*\"([A-Za-z_0-9]+)\"")
PASSED_ON = re.compile(
    r"\b(?:unit_direction|error_length|count|count_or|read_criterion|read_points|list_or|list_at|path_of|one_of|"
    r"spring_number|numbers_of<\d>|pair_of|number_within|read_deviation|point_of|read_closed_mesh|read_text|is_empty|amount|quantity)"
    r"\(\s*(?:\*?(?:table_?|root|entry|blank|setup|controller|sound|inspection))\s*,\s*(?:[A-Za-z.]+, )?\"([A-Za-z_0-9]+)\"")
LAMBDAS = re.compile(r"\b(?:limit|length|temperature|expansion|share|amount|position|read|read_spacing|parsed)\("
                     r"\s*(?:table, )?\"([A-Za-z_0-9]+)\"")
SPACING = re.compile(r"\bread_spacing\(table, \"([a-z_]+)\"")
# The order of the questions, `key.name` of tables of keys: {"diameter", kDiameter, true}.
ROWS = re.compile(r"\{\"([A-Za-z_0-9]+)\", (?:&|k[A-Z])")
HEADERS = re.compile(r"HeaderKey\{\"([a-z_]+)\"")
WORDS_OF_KEYS = re.compile(r"WordsOfKey\{\"([a-z_]+)\"")
LISTS = re.compile(r"for \(const char\* (?:key|name) :\s*\{([^}]*)\}\)", re.S)
CHOSEN = re.compile(r"const char\* (?:bottom|other|key) =[^;]*;", re.S)


def keys_of(file):
    """All keys that the source asks for."""
    text = re.sub(r"//[^\n]*", "", (ROOT / file).read_text())
    found = set()
    for pattern in (ASKED, PASSED_ON, LAMBDAS, SPACING, ROWS, HEADERS, WORDS_OF_KEYS):
        found |= set(pattern.findall(text))
    for pattern in (LISTS, CHOSEN):
        for match in pattern.finditer(text):
            found |= set(re.findall(r"\"([A-Za-z_0-9]+)\"", match.group(0)))
    return found
