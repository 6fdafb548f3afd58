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
# What may precede a statement in its line; what is declared and set; what a statement begins with that declares nothing.
HEAD = r"\} |else |(?:if|while|for|switch) \(|case [\w:]+: |default: "
DECLARED = r"(?:[\w:]+(?:<[^=()]*>)?[\s&*]+)+(?:\w+|\[[\w, ]+\])"
SIMPLE = r"(?!alignas)(?:return|throw|delete)\b|continue;|\+\+|--|\*|\(|[\w:]+(?:<[^;=()]*>)?(?:\(|\.|->|\[| [-+*/|&^%<>]*= |\+\+| << )"
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
    slot: "Slot"

    def key(self):
        return f"{self.file}:{sha256((self.before + '→' + self.after).encode()).hexdigest()[:16]}"

    def applied(self, text):
        lines = text.splitlines(True)
        assert lines[self.line - 1].rstrip("\n") == self.before
        lines[self.line - 1] = self.after + "\n"
        return "".join(lines)

    def both(self, number):
        """Returns the line that does as `after` where this mutant is active, by its number, and else as `before`."""
        start, end = self.slot.start, self.slot.end
        whole, broken = self.before[start:end], self.after[start:end + len(self.after) - len(self.before)]
        active, to = f"::vitrail_mutant({number})", "bool" if self.slot.kind == "condition" else ""
        both = f"{active} ? {to}({broken}) : {to}({whole})"
        if self.slot.kind == "statement":
            both = f"{{ if ({active}) {{ {broken} }} else {{ {whole} }} }}"
        return self.before[:start] + both + self.before[end:]


@dataclass
class Slot:
    """A part of a line in whose place there may be two, of which one is chosen at run time."""
    start: int
    end: int
    kind: str = "expression"  # or "condition" or "statement"

    def has(self, before, after):
        """Returns whether two lines differ in the slot alone."""
        return before[:self.start] == after[:self.start] and before[self.end:] == after[self.end + len(after) - len(before):]


def blanked(text):
    """Returns the text with comments as spaces and the contents of strings and characters as underscores, of the same length."""
    def blank(match):
        return re.sub(r"[^\n]", " " if match[0][0] == "/" else "_", match[0])
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


def parts(code, start, end, separator):
    """Yields where the parts of code[start:end] begin and end, of which separators in no bracket are between."""
    depth, first = 0, start
    for i in range(start, end):
        depth += (code[i] in "([{") - (code[i] in ")]}")
        if depth == 0 and code.startswith(separator, i):
            yield first, i
            first = i + len(separator)
    yield first, end


def expression(code, start, end, kind="expression"):
    """Yields the slot of an expression, or of what a declaration's name is set to; none where it is in no pair of round brackets."""
    start += len(code[start:end]) - len(code[start:end].lstrip())
    equal = list(parts(code, start, end, " = "))
    if len(equal) == 2 and re.fullmatch(DECLARED, code[start:equal[0][1]]):
        start, kind = equal[1][0], "expression"
    if start < end and code[start] not in "[{" and len(list(parts(code, start, end, ","))) == 1 and closing(code[:end], start) is None:
        yield Slot(start, end, kind)


def slots_of(code, is_function, starts):
    """Yields the slots of a blanked line, the smallest last; `starts`: a statement begins with the line."""
    if re.search(r"\bconstexpr\b.*(?: = |\w\{)|\bif constexpr\b", code):
        return
    at = len(code) - len(code.lstrip())
    while starts and (head := re.compile(HEAD).match(code, at)):
        at = head.end()
        if head[0].endswith("("):
            end = closing(code, at)
            if end is None:
                return
            for first, last in parts(code, at, end, ";"):
                is_for, ranges = head[0].startswith("for"), list(parts(code, first, last, " : "))
                kind = "condition" if head[0].startswith(("if", "while")) else "expression"
                yield from expression(code, ranges[-1][0] if is_for else first, last, kind)
            at = end + 1
            at += code.startswith(" ", at)
    end = len(code)
    is_whole = starts and code.endswith(";") and closing(code, at) is None and len(list(parts(code, at, end, ";"))) == 2
    if is_whole and re.fullmatch(DECLARED + " = .*", code[at:end]):
        if not is_function and code[0] != " ":
            return  # a variable of a namespace, whose value the compiler finds
        yield from expression(code, at, end - 1)
    elif is_whole and is_function and re.match(SIMPLE, code[at:]):
        yield Slot(at, end, "statement")
    elif member := re.match(r"\s*\.\w+ = (.*?),?$", code):
        yield from expression(code, *member.span(1))
    if not re.search(r"\b(?:struct|class|enum|union)\b", code):
        for block in re.finditer(r"[)\w>\]] \{ ([^{}]*;) \}", code):
            yield Slot(*block.span(1), "statement")
    if is_function:
        for bracket in re.finditer(r"(?<![\]}])\(", code):
            end = closing(code, bracket.end())
            if end is not None:
                for first, last in parts(code, bracket.end(), end, ","):
                    yield from expression(code, first, last)


def are_functions(code):
    """Returns for each line of a blanked text whether it begins in a function's body."""
    found, open_, head = [], [], ""
    for line in code.splitlines():
        found.append(bool(open_) and open_[-1])
        for c in "" if line.startswith("#") else line + " ":
            if c == "{":
                open_.append(re.search(r"\b(?:namespace|struct|class|enum|union|extern)\b[^(){}=]*$", head) is None)
            elif c == "}" and open_:
                open_.pop()
            head = "" if c in ";{}" else head + c
    return found


def mutants_of(file, text):
    """Returns the mutants of a source, a list for each line that has any."""
    found, previous, blank = [], ";", blanked(text)
    for i, (line, code, is_function) in enumerate(zip(text.splitlines(), blank.splitlines(), are_functions(blank))):
        code = code.rstrip()
        # After a head that ends its line, a single statement.
        starts = re.search(r"[;{}:]$", previous) or re.match(r"\s*(?:\} )?(?:else$|(?:else )?(?:if|for|while) \(.*\)$)", previous)
        if code.strip(" _"):
            previous = code
        is_of_table = not re.search("[a-zA-Z]{2}", code) or len(re.findall(NUMBER, code)) > 5
        if LEFT_OUT.search(code) or is_of_table:
            continue
        slots = list(slots_of(code, is_function, starts))
        code = MESSAGE.sub(lambda m: "_" * len(m[0]), code) if "if (" in code or "return" in code or "throw" in code else code
        here = []
        for name, other in other_lines(line, code):
            slot = next((slot for slot in slots if slot.has(line, other)), None)
            if slot and (name != "statement removed" or slot.kind == "statement" and starts):
                here.append(Mutant(file, i + 1, name, line, other, slot))
        if here:
            found.append(here)
    return found
