"""Finds the places of a C++ source that can be changed, and writes a source that holds all of their changes.

The sources are formatted by clang-format, and that is what makes a tokenizer enough: an operator of two operands stands
between spaces, brackets of templates do not.
"""
import bisect
import dataclasses
import re

SPACED = r"(?<=\s){}(?=\s)"
PATTERNS = [  # kind, what is changed
    ("comparison", SPACED.format(r"(?:<=|>=|==|!=|<|>)")),
    ("arithmetic", SPACED.format(r"[-+*/%]=?")),
    ("logic", SPACED.format(r"(?:&&|\|\|)")),
    ("logic", r"!(?=[\w(])"),
    ("sign", r"(?:(?<=[(,={\[] )|(?<=[({\[])|(?<=return )|(?<=[?:*/+<>-] ))-(?=[\w(])"),
    ("constant", r"(?<![\w.'])(?:\d[\d']*(?:\.\d*)?|\.\d+)(?:e[-+]?\d+)?[fFuUlL]*(?![\w.'])"),
    ("constant", r"\b(?:true|false)\b"),
    ("bound", r"(?<![\w.>:])(?:std::)?(?:min|max|saturate|abs)(?=\()"),
]
# Code that is evaluated at compile time, before a process could change it, and code that is not an expression.
UNTOUCHED = re.compile(r"\b(?:static_assert|requires|concept|enum|using|alignas|if constexpr|case|operator|extern"
                       r"|friend bool operator\S+|friend constexpr bool operator\S+)\b|^\s*template\b")
FIRST = {"<": "<=", ">": ">=", "<=": "<", ">=": ">", "==": "!=", "!=": "==", "+": "-", "-": "+", "*": "/", "/": "*",
         "%": "/", "+=": "-=", "-=": "+=", "*=": "/=", "/=": "*=", "&&": "||", "||": "&&", "!": "", "true": "false",
         "false": "true", "min": "max", "max": "min", "saturate": "", "abs": ""}
SECOND = {"<": ">=", ">": "<=", "<=": ">", ">=": "<", "*": "2 *"}
OPEN, CLOSE = "([{", ")]}"


@dataclasses.dataclass
class Site:
    path: str  # below the root
    kind: str
    start: int
    end: int
    line: int  # from 1
    column: int
    old: str
    changes: list  # the first and the second, see mutant.h
    text: str  # the whole line
    constant: bool  # in a constexpr function
    reach: tuple = None  # what is written anew, where that is more than the operator: logic and bounds
    unfreeze: tuple = None  # (start, end, text): a `constexpr` that must go, for a constant is changed
    thawed: str = ""  # that constant's name

    @property
    def name(self):
        return f"{self.path}:{self.line}:{self.column}"

    def changed_line(self, change=0):
        at = self.column - 1
        return self.text[:at] + self.changes[change] + self.text[at + len(self.old):]

    def span(self):
        return self.reach or (self.start, self.end)


def masked(text):
    """The text with everything except code replaced by spaces, of the same length."""
    blank = lambda match: re.sub(r"[^\n]", " ", match.group())
    return re.sub(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\])\'|^[ \t]*#(?:\\\n|[^\n])*|\[\[[^\]]*\]\]',
                  blank, text, flags=re.S | re.M)


def closing(code, at):
    """The position of the bracket that closes the bracket at `at`."""
    depth = 0
    for i in range(at, len(code)):
        if code[i] in OPEN:
            depth += 1
        elif code[i] in CLOSE:
            depth -= 1
            if depth == 0:
                return i
    return None


def headers(code):
    """For each pair of braces: (opening position, closing position, the text before it)."""
    found, stack, begin = [], [], 0
    for match in re.finditer(r"[;{}()]", code):
        i, c = match.start(), match.group()
        if c == "(":
            stack.append(("(", i, ""))
        elif c == ")":
            if stack and stack[-1][0] == "(":
                stack.pop()
        elif c == "{":
            stack.append(("{", i, code[begin:i]))
            begin = i + 1
        elif c == "}":
            while stack and stack[-1][0] == "(":
                stack.pop()
            if stack:
                _, start, header = stack.pop()
                found.append((start, i, header))
            begin = i + 1
        elif not (stack and stack[-1][0] == "("):
            begin = i + 1
    return sorted(found)


def operand(code, at, step, ends):
    """The far end of the operand that begins at `at` and goes left (step -1) or right (1)."""
    opening, shutting = (CLOSE, OPEN) if step < 0 else (OPEN, CLOSE)
    depth, angle, i = 0, 0, at
    while 0 <= i < len(code):
        c = code[i]
        before = code[i - 1] if i else " "
        if c in opening:
            if depth == 0 and step < 0 and c == "}" and not code[i + 1:].split("\n", 1)[0].strip():
                break  # the end of a statement
            depth += 1
        elif c in shutting:
            if depth == 0:
                break
            depth -= 1
        elif depth == 0:
            template_close = c == ">" and before not in " -\n" and code[i - 1:i + 1] != "->"
            template_open = c == "<" and before not in " \n" and code[i + 1] not in " =\n"
            if template_close:
                angle += -step
            elif template_open:
                angle += step
            elif angle == 0:
                if c in ";,?" or (c == ":" and code[i + 1] != ":" and before != ":"):
                    break
                two = code[i:i + 2] if step > 0 else code[i - 1:i + 1]
                if two in ends:
                    break
                if c == "=" and before == " " and code[i + 1] in " \n":
                    break
                if step < 0 and re.search(r"\breturn$", code[max(0, i - 6):i + 1]):
                    break
        i += step
    return i + 1 if step < 0 else i


def is_guard(text):
    """Whether a number is so small or large that it only keeps others from 0 or from infinity: half as much again of it is
    no fault."""
    value = float(text.rstrip("fFuUlL").replace("'", ""))
    return value != 0 and not 1e-5 <= value < 1e5


def other_number(text):
    body = text.rstrip("fFuUlL")
    suffix = text[len(body):]
    value = float(body.replace("'", ""))
    if re.fullmatch(r"[\d']+", body):
        return f"{int(value) + 1}{suffix}"
    other = 1.0 if value == 0 else value * 1.5
    written = f"{other:.17g}"
    short = f"{other:.6g}"
    written = short if float(short) != value else written
    return (written if re.search(r"[.e]", written) else written + ".0") + suffix


class Source:
    def __init__(self, path, text):
        self.path, self.text, self.code = path, text, masked(text)
        self.lines = [0] + [match.end() for match in re.finditer("\n", text)]
        self.braces = headers(self.code)

    def statement(self, at):
        """The beginning of the statement that contains `at`."""
        start = max(self.code.rfind(c, 0, at) for c in ";{}")
        return start + 1

    def context(self, at):
        """(site is left out, site is in a constexpr function, the `constexpr` that must be removed)."""
        around = [(start, header) for start, end, header in self.braces if start < at < end]
        begin = self.statement(at)
        around.append((at, self.code[begin:at]))
        function = any("(" in header and "struct " not in header for _, header in around[:-1])
        constant, unfreeze = False, None
        for start, header in around:
            if re.search(r"\benum\b", header):
                return True, False, None
            word = re.search(r"(?:\b(static|inline) )?\bconstexpr\b(?! \w+ operator)", header)
            if not word or "if constexpr" in header:
                continue
            declared = header[word.end():]
            if "(" in declared.split("=")[0]:
                constant = True
                continue
            place = start - len(header) + word.start()
            written = "const" if not word.group(1) else "static const" if function else "static inline const"
            if word.group(1) == "inline":
                written = "inline const"
            unfreeze = (place, place + len(word.group()), written)
        return False, constant, unfreeze

    def name_behind(self, at):
        """The name that the declaration with a `constexpr` at `at` declares."""
        declared = re.split(r"[={;]|\[\w*\] ", self.code[at:self.code.index(";", at)], maxsplit=1)[0]
        return (re.findall(r"\w+", declared.split("[")[0]) or [""])[-1]

    def sites(self):
        found = []
        for kind, pattern in PATTERNS:
            for match in re.finditer(pattern, self.code):
                site = self.site(kind, match)
                if site:
                    found.append(site)
        return sorted(found, key=lambda site: site.start)

    def site(self, kind, match):
        start, end, old = match.start(), match.end(), match.group()
        line = bisect.bisect_right(self.lines, start)
        row = self.text[self.lines[line - 1]:].split("\n", 1)[0]
        begin = self.statement(start)
        before = self.code[begin:start]
        if UNTOUCHED.search(before.strip()) or UNTOUCHED.search(row):
            return None
        left_out, constant, unfreeze = self.context(start)
        if left_out:
            return None
        site = Site(self.path, kind, start, end, line, start - self.lines[line - 1] + 1, old, [], row, constant,
                    unfreeze=unfreeze, thawed=self.name_behind(unfreeze[0]) if unfreeze else "")
        if kind == "constant":
            near, far = self.code[start - 1], self.code[end]
            if near in "<[" or (far in ">]" and self.code[end:end + 2] != "> ") or re.search(r"<[^<>;(){} ]*, $", before):
                return None
            if old[0] in ".0123456789" and is_guard(old):
                return None
            site.changes = [FIRST.get(old) or other_number(old)]
        elif kind == "bound":
            shut = closing(self.code, end)
            word = old.split("::")[-1]
            if shut is None or re.search(r"[\w>&*] $", self.code[:start]) and not re.search(r"\breturn $|\bin $", self.code[:start]):
                return None  # a declaration
            site.reach = (start, shut + 1)
            site.changes = [old.replace(word, FIRST[word]) if FIRST[word] else ""]
        elif kind == "logic" and old != "!":
            ends = ("&&", "||") if old == "&&" else ("||",)
            low = operand(self.code, start - 1, -1, ends)
            high = operand(self.code, end, 1, ends)
            piece = self.code[low:high]
            site.reach = (low + len(piece) - len(piece.lstrip()), high - len(piece) + len(piece.rstrip()))
            site.changes = [FIRST[old]]
        elif kind == "sign":
            site.changes = [""]
        else:
            if old == "*" and not before.strip():
                return None
            site.changes = [FIRST[old], SECOND.get(old, FIRST[old])]
        if site.reach:
            piece = self.text[site.reach[0]:site.reach[1]]
            if "//" in piece or "\n#" in piece or "/*" in piece:
                return None
        return site

    def with_changes(self, numbered):
        """The text with all sites of `numbered`, pairs (number, site). No two sites may overlap in part."""
        edits = sorted(((site.span(), number, site) for number, site in numbered),
                       key=lambda edit: (edit[0][0], -edit[0][1], edit[2].reach is None))
        thaws = {site.unfreeze for _, site in numbered if site.unfreeze}
        return self.written(0, len(self.text), edits, thaws)

    def written(self, low, high, edits, thaws):
        out, at = [], low
        inside = [edit for edit in edits if low <= edit[0][0] and edit[0][1] <= high]
        pieces = [(edit[0][0], edit[0][1], edit) for edit in inside]
        pieces += [(start, end, text) for start, end, text in thaws if low <= start and end <= high]
        for start, end, edit in sorted(pieces, key=lambda piece: (piece[0], -piece[1])):
            if start < at:
                continue  # inside of what has been written
            out.append(self.text[at:start])
            if isinstance(edit, str):
                out.append(edit)
            else:
                rest = [other for other in inside if other is not edit]
                out.append(self.change(edit[1], edit[2], rest))
            at = end
        out.append(self.text[at:high])
        return "".join(out)

    def change(self, number, site, inner):
        place = f"{number}, {'true' if site.constant else 'false'}"
        if site.reach:
            low, high = site.reach
            flat = lambda a, b: self.written(a, b, inner, ()).replace("\n", " ")
            if site.kind == "logic":
                changed = f"{flat(low, site.start).strip()} {site.changes[0]} {flat(site.end, high).strip()}"
                kept = self.written(low, site.start, inner, ()) + site.old + self.written(site.end, high, inner, ())
                return f"(limpid_mutants::on<{place}>() ? ({changed}) : ({kept}))"
            changed = f"{site.changes[0]}{flat(site.end, high)}"
            return f"(limpid_mutants::on<{place}>() ? {changed} : {site.old}{self.written(site.end, high, inner, ())})"
        if site.kind == "constant":
            return f"limpid_mutants::number<{place}>({site.old}, {site.changes[0]})"
        if site.old == "!":
            return f"limpid_mutants::Not<{place}>() ->* "
        if site.kind == "sign":
            return f"limpid_mutants::Negative<{place}>() ->* "
        return f"{site.old} limpid_mutants::Mark<{place}>() {site.old}"


def overlaps(a, b):
    """In part: neither holds the other. Of two of one operator one at most can be."""
    (a0, a1), (b0, b1) = a.span(), b.span()
    if a1 <= b0 or b1 <= a0:
        return False
    holds = (a0 <= b0 and b1 <= a1) or (b0 <= a0 and a1 <= b1)
    return not holds or (a0, a1) == (b0, b1)
