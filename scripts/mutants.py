# SPDX-License-Identifier: Apache-2.0
"""The ways in which scripts/mutate breaks a line of C++."""
import re
from dataclasses import dataclass
from hashlib import sha256

# What stands in a line whose strings and comments are blanked, and what takes its place. The spaces around an operator are
# clang-format's: without them <, > and * are of types.
SWAPS = [
    (r" < (?!<)", " <= "), (r" <= ", " < "), (r" > (?!>)", " >= "), (r" >= ", " > "), (r" == ", " != "), (r" != ", " == "),
    (r" && ", " || "), (r" \|\| ", " && "), (r" \+ ", " - "), (r" - ", " + "), (r" \* ", " / "), (r" / ", " * "), (r" % ", " / "),
    (r" \+= ", " -= "), (r" -= ", " += "), (r" \*= ", " /= "), (r" /= ", " *= "), (r" \^ ", " | "), (r" << ", " >> "), (r" >> ", " << "),
    (r"\bstd::min\b", "std::max"), (r"\bstd::max\b", "std::min"), (r"\btrue\b", "false"), (r"\bfalse\b", "true"),
    (r"\bcontinue;", ";"), (r"\bstd::abs\(", "("), (r"(?<=[ (=])-(?=[\w(])", ""),
]
CONDITION = r"\bif \((?!const\b|auto\b|!)"
NUMBER = r"(?<![\w.'])(?<!p-)(\d[\d']*\.?\d*(?:e-?\d+)?)(f|u|)(?![\w.'])"
ARGUMENTS = r"(?<=[\w>]\()(\w[\w.\->]*), (\w[\w.\->]*)(?=[,)])"
STATEMENT = r"^\s+(?!return\b|break\b)(?:[\w.:\->\[\]]+(?: [-+*/|&^]?= .+|\(.*\))|\+\+[\w.\->]+|--[\w.\->]+);$"
# Lines that say something to the compiler, to the allocator or about progress alone.
LEFT_OUT = re.compile(r"^\s*(#|using |namespace|template|static_assert|assert|friend|case .*:$|\[\[|requires|concept|struct|class|enum)"
                      r"|reserve\(|shrink_to_fit|say\(|\boperator|Underway|= default")
MESSAGE = re.compile(r"\bthrow\b.*|fmt::.*")


@dataclass
class Mutant:
    file: str
    line: int  # from 1
    name: str
    before: str
    after: str

    def key(self):
        return f"{self.file}:{sha256((self.before + '→' + self.after).encode()).hexdigest()[:16]}"

    def applied(self, text):
        lines = text.splitlines(True)
        assert lines[self.line - 1].rstrip("\n") == self.before
        lines[self.line - 1] = self.after + "\n"
        return "".join(lines)


def blanked(text):
    """Returns the text with the contents of comments, strings and characters as underscores of the same length."""
    def blank(match):
        return re.sub(r"[^\n]", "_", match[0])
    return re.sub(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<![\w])\'(?:\\.|[^\'\\\n])+\'', blank, text, flags=re.S)


def closing(code, start):
    """Returns the place of the bracket that closes the one before `start`, or None."""
    depth = 1
    for i in range(start, len(code)):
        depth += (code[i] in "([{") - (code[i] in ")]}")
        if depth == 0:
            return i
    return None


def other_lines(line, code):
    """Returns pairs of a name and the line broken so; `code` is the line blanked."""
    def replaced(start, end, instead):
        return line[:start] + instead + line[end:]

    for pattern, instead in SWAPS:
        for m in re.finditer(pattern, code):
            yield f"{m[0].strip()} → {instead.strip()}", replaced(m.start(), m.end(), instead)
    for m in re.finditer(CONDITION, code):
        end = closing(code, m.end())
        if end is not None and ";" not in code[m.end():end]:
            yield "condition negated", replaced(m.end(), end, "!(" + line[m.end():end] + ")")
    for m in re.finditer(NUMBER, code):
        is_real, value = "." in m[1] or "e" in m[1], float(m[1].replace("'", ""))
        instead = [f"({m[0]} + 1)" if is_real else f"{value + 1:.0f}{m[2]}"] + (["0.0" + m[2] if is_real else "0" + m[2]] if value else [])
        for other in instead:
            yield f"{m[0]} → {other}", replaced(m.start(), m.end(), other)
    for m in re.finditer(ARGUMENTS, code):
        if m[1] != m[2]:
            yield "arguments swapped", replaced(m.start(), m.end(), line[m.start(2):m.end(2)] + ", " + line[m.start(1):m.end(1)])
    for m in re.finditer(r"\bstd::clamp\(", code):
        end = closing(code, m.end())
        if end is not None:
            first = code[m.end():end].split(", ")[0]
            yield "clamp dropped", replaced(m.start(), end + 1, "(" + line[m.end():m.end() + len(first)] + ")")
    if re.match(STATEMENT, code):
        yield "statement removed", re.match(r"\s*", line)[0] + ";"


def mutants_of(file, text):
    """Returns the mutants of a source, a list for each line that has any."""
    found, previous = [], ";"
    for i, (line, code) in enumerate(zip(text.splitlines(), blanked(text).splitlines())):
        starts = re.search(r"[;{}:]\s*_*$", previous) is not None  # a statement
        if code.strip(" _"):
            previous = code
        is_of_table = not re.search("[a-zA-Z]{2}", code) or len(re.findall(NUMBER, code)) > 5
        if LEFT_OUT.search(code) or is_of_table:
            continue
        code = MESSAGE.sub(lambda m: "_" * len(m[0]), code) if "if (" in code or "return" in code or "throw" in code else code
        here = [Mutant(file, i + 1, name, line, other) for name, other in other_lines(line, code)
                if starts or name != "statement removed"]
        if here:
            found.append(here)
    return found
