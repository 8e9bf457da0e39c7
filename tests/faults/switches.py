"""Many faults in one build: a line and its faulty forms become one line, which is chosen by a number while the program runs.

A build takes minutes and a run seconds, so faults share a build: in a scratch copy `x + y` becomes
`(if contract::fault(7) { x - y } else { x + y })`, and the environment variable CGT_FAULT says which number is on. Only one can
be. With none on, the program is the shipped one but for the question, and the killers must all pass.

What is chosen is the smallest whole expression in which the forms differ: an argument, what stands after `=`, a condition, a
statement. Patterns, types, constants and what else cannot be an `if` are built alone.
"""

import re
import zlib

VARIABLE = "CGT_FAULT"

# Appended to the crate `contract`, of which all others know. The number is read before `main`, so that asking costs a comparison:
# with more at each place the compiler would take many times as long for what is inlined everywhere.
SOURCE = '''
/// Number of the fault that is on; the largest means none.
static FAULT: std::sync::atomic::AtomicU32 = std::sync::atomic::AtomicU32::new(u32::MAX);

/// Whether the seeded fault of that number is on.
#[inline(always)]
#[must_use]
pub fn fault(number: u32) -> bool {
    FAULT.load(std::sync::atomic::Ordering::Relaxed) == number
}

extern "C" fn read_fault() {
    let on = std::env::var("CGT_FAULT").ok().and_then(|text| text.parse().ok());
    FAULT.store(on.unwrap_or(u32::MAX), std::sync::atomic::Ordering::Relaxed);
}

#[used]
#[allow(unsafe_code)]
#[cfg_attr(target_os = "macos", unsafe(link_section = "__DATA,__mod_init_func"))]
#[cfg_attr(not(target_os = "macos"), unsafe(link_section = ".init_array"))]
static READ_FAULT: extern "C" fn() = read_fault;
'''

TOKEN = re.compile(r'''
    (?P<blank>\s+ | //.*)
  | b?r(\#*)".*?"\2 | b?"(?:\\.|[^"\\])*" | b?'(?:\\[^']*|[^'\\])' | '[A-Za-z_]\w*
  | \d[\w]*(?:\.\d[\w]*)?(?:[eE][+-]?\d+)?\w* | [A-Za-z_]\w*!? (?!=) | [A-Za-z_]\w*
  | <<= | >>= | \.\.= | \.\.\. | => | -> | == | != | <= | >= | && | \|\| | \+= | -= | \*= | /= | %= | \^= | &= | \|= | :: | \.\.
  | .
''', re.VERBOSE)
OPEN, CLOSE = {"(": ")", "[": "]", "{": "}"}, {")", "]", "}"}
ASSIGN = {"=", "+=", "-=", "*=", "/=", "%=", "^=", "&=", "|=", "<<=", ">>="}
BEFORE = {",", ";", "=>", "return", "if", "while", "match", "in", "else", ":"} | ASSIGN
AFTER = {",", ";"} | CLOSE
# Before the parameters of a closure.
STARTS = {"(", ",", "=", "move", "{", "return", "=>"}
ITEMS = {"let", "use", "const", "static", "fn", "pub", "struct", "enum", "impl", "trait", "type", "mod", "#", "where"}


class NoSwitch(Exception):
    """Lines that cannot be chosen between while the program runs."""


def number(name):
    """A fault's number; it depends on nothing but its name."""
    return zlib.crc32(name.encode()) & 0x7fff_ffff


def tokens(text):
    """Words and signs with where they begin and end."""
    return [(m.group(), m.start(), m.end()) for m in TOKEN.finditer(text) if m.group("blank") is None]


def is_balanced(words):
    expected = []
    for word in words:
        if word in OPEN:
            expected.append(OPEN[word])
        elif word in CLOSE and (not expected or expected.pop() != word):
            return False
    return not expected


def closes_parameters(words, i):
    """Whether the `|` at i ends the parameters of a closure."""
    for j in range(i - 1, -1, -1):
        if words[j] == "|":
            return j == 0 or words[j - 1] in STARTS
        if words[j] in {";", "=>"}:
            return False
    return False


def in_parameters(words, at):
    """Whether a place is among the parameters of a closure."""
    depth = 0
    for i in range(at - 1, -1, -1):
        depth += (words[i] in CLOSE) - (words[i] in OPEN)
        if depth < 0:
            return False
        if depth == 0 and words[i] == "|":
            return not closes_parameters(words, i) and (i == 0 or words[i - 1] in STARTS)
    return False


def left(words, at, until):
    """Where the expression begins that holds what is before `at`, and goes on to `until` at least."""
    depth = 0
    for i in range(at - 1, -1, -1):
        word = words[i]
        if word in CLOSE:
            depth += 1
        elif word in OPEN:
            if depth == 0:
                return i + 1
            depth -= 1
        elif depth == 0 and word in {"if", "while", "match"} and has_block(words[i + 1:until]):
            continue
        elif depth == 0 and (word in BEFORE or (word == "||" and (i == 0 or words[i - 1] in {"(", ",", "="}))):
            return i + 1
        elif depth == 0 and word == "|" and closes_parameters(words, i):
            return i + 1
    return 0


def has_block(words):
    """Whether a bracket of a block opens outside of all others."""
    depth = 0
    for word in words:
        if word == "{" and depth == 0:
            return True
        depth += (word in OPEN) - (word in CLOSE)
    return False


def is_head(words, begin):
    """Whether what begins there stands before a block, or before the arrow of an arm with a condition."""
    if begin == 0:
        return False
    is_let = words[begin - 1] == "=" and "let" in words and ("if" in words or "while" in words)
    return is_let or words[begin - 1] in {"if", "while", "match", "in"}


def right(words, at, is_head):
    """Where it ends."""
    depth = 0
    for i in range(at, len(words)):
        word = words[i]
        if word == "{" and depth == 0 and is_head:
            return i
        if word in CLOSE:
            if depth == 0:
                return i
            depth -= 1
        elif word in OPEN:
            depth += 1
        elif depth == 0 and (word in AFTER or (word == "else" and i > 0 and words[i - 1] != "}")):
            return i
        elif depth == 0 and word == "=>" and is_head:
            return i
        elif depth == 0 and word == "=>":
            raise NoSwitch("a pattern")
    return len(words)


def unmatched(words):
    """Brackets that close without having opened, and that open without closing."""
    closed = opened = 0
    for word in words:
        if word in OPEN:
            opened += 1
        elif word in CLOSE and opened:
            opened -= 1
        elif word in CLOSE:
            closed += 1
    return closed, opened


def mirrored(words):
    other = {"(": ")", "[": "]", "{": "}", ")": "(", "]": "[", "}": "{"}
    return [other.get(word, word) for word in reversed(words)]


def enclosing(words, at, levels):
    """Index of the bracket that opens so many levels around a place; the place itself if there are none to go.

    Raises NoSwitch if it opens before the line.
    """
    depth = 0
    for i in range(at - 1, -1, -1):
        if levels == 0:
            break
        if words[i] in CLOSE:
            depth += 1
        elif words[i] in OPEN and depth:
            depth -= 1
        elif words[i] in OPEN:
            levels, at = levels - 1, i
    if levels:
        raise NoSwitch("no whole expression")
    return at


def is_one(words):
    """Whether that can be one expression: brackets match, and outside of them nothing separates."""
    depth = 0
    for word in words:
        depth += (word in OPEN) - (word in CLOSE)
        if depth == 0 and word in {",", ";", ":"}:
            return False
    return is_balanced(words)


def is_pattern(words, begin, end):
    """Whether what lies between is matched against: it stands before `=>` and not after an `if`, or between `let` and `=`."""
    arms = [i for i in range(end, len(words)) if words[i] == "=>" and is_outside(words, end, i)]
    if arms and "if" not in words[:begin]:
        return True
    lets = [i for i in range(begin) if words[i] == "let"]
    return bool(lets) and "=" not in words[lets[-1]:begin] and "=" in words[end:]


def is_outside(words, start, at):
    """Whether no bracket that opens after `start` is open at a place."""
    depth = 0
    for word in words[start:at]:
        depth = max(depth + (word in OPEN) - (word in CLOSE), 0)
    return depth == 0


def is_bound(words, begin, part):
    """Whether a part cannot be chosen by itself: the text of a macro must be a literal, and arguments of a format live no longer than
    the call that they are made in."""
    if part[0] == "format_args!":
        return True
    if not part[0].startswith('"'):
        return False
    try:
        bracket = enclosing(words, begin, 1)
    except NoSwitch:
        return False
    return bracket > 0 and len(words[bracket - 1]) > 1 and words[bracket - 1].endswith("!")


def is_statement(words):
    if not words or not is_balanced(words) or words[0] in ITEMS | {".", "else", "}"}:
        return False
    return words[-1] == ";" or (words[-1] == "}" and words[0] in {"if", "for", "while", "loop", "{"})


def switch(line, forms, before="", after=""):
    """One line in place of another that chooses between it and its forms, a list of (condition, text); the lines around it tell
    what begins and ends with it.

    Raises NoSwitch.
    """
    blank = line[:len(line) - len(line.lstrip())]
    line = line.strip()
    own = tokens(line)
    others = [tokens(text) for _, text in forms]
    words = [[word for word, _, _ in of] for of in [own, *others]]
    if words[0][0] in ITEMS - {"let"}:
        raise NoSwitch("no expression")
    if any(not of for of in words):
        if not is_statement(words[0]):
            raise NoSwitch("what is left out is no statement")
        return blank + chosen([(condition, text) for condition, text in forms], line, "")
    shortest = min(map(len, words))
    start = next((i for i in range(shortest) if len({of[i] for of in words}) > 1), shortest)
    tail = next((i for i in range(shortest - start) if len({of[-1 - i] for of in words}) > 1), shortest - start)
    while True:
        begin = left(words[0], start, len(words[0]) - tail)
        ends = [right(of, max(begin, len(of) - tail), is_head(of, begin)) for of in words]
        parts = [of[begin:end] for of, end in zip(words, ends)]
        rests = {tuple(of[end:]) for of, end in zip(words, ends)}
        is_whole = all(parts) and all(map(is_one, parts)) and len(rests) == 1 and not in_parameters(words[0], begin)
        if is_whole and not any(is_bound(words[0], begin, part) for part in parts):
            break
        # Out of as many brackets as the forms close and open, or else out of the next ones around.
        out = [unmatched(of[begin:end]) for of, end in zip(words, ends)]
        closers, openers = max(closed for closed, _ in out), max(opened for _, opened in out)
        if closers == openers == 0:
            closers = openers = 1
        try:
            start = enclosing(words[0], begin, closers)
            afters = [len(of) - 1 - enclosing(mirrored(of), len(of) - end, openers) + 1 for of, end in zip(words, ends)]
        except NoSwitch:
            if all(map(is_statement, words)):
                return blank + chosen(forms, line, "")
            raise
        tail = min(len(of) - after for of, after in zip(words, afters))
    if is_pattern(words[0], begin, ends[0]) or parts[0][0] in {".", "?"} or "let" in parts[0]:
        raise NoSwitch("a pattern")
    first, last = begin == 0, ends[0] == len(words[0])
    if first and words[0][0] in {"&&", "||"} and all(of[0] == words[0][0] for of in words):
        begin, first = 1, False
    if first and before and before.rstrip()[-1:] not in {"{", "}", ";", ",", "(", "[", "=", "|", ">"}:
        raise NoSwitch("it begins before the line")
    allowed = {"}", ")", "]"} | ({"{"} if words[0][0] in {"&&", "||"} else set())
    if last and after and after.lstrip()[:1] not in allowed and after.lstrip()[:2] not in {"&&", "||"}:
        raise NoSwitch("it ends after the line")
    cut = lambda text, of, end: text[of[begin][1]:of[end - 1][2]]
    texts = [cut(text, of, end) for (_, text), of, end in zip([("", line), *forms], [own, *others], ends)]
    choice = chosen([(condition, text) for (condition, _), text in zip(forms, texts[1:])], texts[0], "()")
    return blank + line[:own[begin][1]] + choice + line[own[ends[0] - 1][2]:]


def chosen(forms, line, around):
    wrap = (lambda text: f"({text})") if around else (lambda text: text)
    arms = "".join(f"if {condition} {{ {wrap(text)} }} else " for condition, text in forms)
    return wrap(f"{arms}{{ {wrap(line)} }}")
