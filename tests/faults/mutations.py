"""The mutants that cargo-mutants lists, as switches: all of them in one build, of which one is on while the program runs.

In: what `cargo mutants --list --json` says, with places and replacements. Out: texts of the files with a question at each place,
`contract::fault(n)`. It is the question of `switches`, asked of a table, so that a run can also tell which places it came to at all.

cargo-mutants replaces text, and so a changed operator may change what binds to what. Chosen is therefore between whole expressions: as
far as `switches` finds them to reach. Faulty forms are plain text, and only the shipped form holds more questions, since one is on at a
time.
"""

import bisect
import fnmatch
import json
import re
import subprocess

import switches
from building import CannotBuild

# The folder into which a run writes what it came to; with it nothing is on.
REACHED = "CGT_REACHED"

# Appended to the crate `contract`. Asking costs a comparison with a byte at a fixed place; all else is in a call that is not made.
SOURCE = '''
const FAULTS: usize = {count};
static ASKED: [std::sync::atomic::AtomicU8; FAULTS] = [const {{ std::sync::atomic::AtomicU8::new(0) }}; FAULTS];
static REACHED: [std::sync::atomic::AtomicU8; FAULTS] = [const {{ std::sync::atomic::AtomicU8::new(0) }}; FAULTS];
static RECORDS: std::sync::atomic::AtomicBool = std::sync::atomic::AtomicBool::new(false);

/// Whether the mutant of that number is on.
#[inline(always)]
#[must_use]
pub fn fault(number: usize) -> bool {{
    ASKED[number].load(std::sync::atomic::Ordering::Relaxed) != 0 && answer(number)
}}

#[cold]
#[inline(never)]
fn answer(number: usize) -> bool {{
    use std::sync::atomic::Ordering::Relaxed;
    if !RECORDS.load(Relaxed) {{
        return true;
    }}
    REACHED[number].store(1, Relaxed);
    ASKED[number].store(0, Relaxed);
    false
}}

extern "C" fn read_fault() {{
    use std::sync::atomic::Ordering::Relaxed;
    if std::env::var_os("CGT_REACHED").is_some() {{
        RECORDS.store(true, Relaxed);
        ASKED.iter().for_each(|asked| asked.store(1, Relaxed));
    }} else if let Some(on) = std::env::var("CGT_FAULT").ok().and_then(|text| text.parse::<usize>().ok()) {{
        ASKED[on].store(1, Relaxed);
    }}
}}

extern "C" fn tell_reached() {{
    if let Some(folder) = std::env::var_os("CGT_REACHED") {{
        let all: Vec<u8> = REACHED.iter().map(|reached| reached.load(std::sync::atomic::Ordering::Relaxed)).collect();
        let _ = std::fs::write(std::path::Path::new(&folder).join(std::process::id().to_string()), all);
    }}
}}

#[used]
#[allow(unsafe_code)]
#[cfg_attr(target_os = "macos", unsafe(link_section = "__DATA,__mod_init_func"))]
#[cfg_attr(not(target_os = "macos"), unsafe(link_section = ".init_array"))]
static READ_FAULT: extern "C" fn() = read_fault;

#[used]
#[allow(unsafe_code)]
#[cfg_attr(target_os = "macos", unsafe(link_section = "__DATA,__mod_term_func"))]
#[cfg_attr(not(target_os = "macos"), unsafe(link_section = ".fini_array"))]
static TELL_REACHED: extern "C" fn() = tell_reached;
'''

ASKS = re.compile(r"contract::fault\((\d+)\)")
# After a block that ends a statement these would go on with it.
GOES_ON = {".", "?", "else", "&&", "||", "==", "!=", "+", "/", "%", "<", ">", "<=", ">=", "as", ")", "]", "}", ",", ";", "=>"}


class Mutant:
    """A change that cargo-mutants would make."""

    def __init__(self, entry):
        self.file, self.genre, self.replacement = entry["file"], entry["genre"], entry["replacement"]
        self.function = entry["function"] or {"function_name": "", "return_type": "", "span": entry["span"]}
        self.span, self.listed = entry["span"], entry["name"]
        self.name = f"{self.file}: {re.sub(r'^[^:]*:[0-9]+:[0-9]+: ', '', entry['name'])}"


def parse(text):
    """Mutants from what cargo-mutants listed, in the order of their places. Names hold no lines, so that they outlast edits: what a file
    has several times is numbered."""
    mutants = [Mutant(entry) for entry in json.loads(text)]
    place = lambda m: (m.file, m.span["start"]["line"], m.span["start"]["column"])
    mutants.sort(key=place)
    counts = {}
    for mutant in mutants:
        counts[mutant.name] = n = counts.get(mutant.name, 0) + 1
        if n > 1:
            mutant.name += f" ({n})"
    return mutants


def listed(command, root, package):
    """What cargo-mutants lists for a package.

    Raises CannotBuild.
    """
    done = subprocess.run([*command, "--list", "--json", "--package", package, "--dir", str(root)], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True)
    if done.returncode != 0:
        raise CannotBuild(f"cargo-mutants: {done.stderr.strip()}")
    return parse(done.stdout)


class Source:
    """A file's text, its tokens and its brackets."""

    def __init__(self, text):
        self.text = text
        self.lines = [0, *(m.end() for m in re.finditer("\n", text))]
        # What stands before a closure would hide that it is one.
        blanked = re.sub(r"#\[[^\]\n]*\]", lambda m: " " * len(m.group()), text)
        self.tokens = [t for t in switches.tokens(blanked)]
        self.words = [word for word, _, _ in self.tokens]
        self.starts = [start for _, start, _ in self.tokens]
        self.inside, self.ends, open_ = [], {}, []
        for i, word in enumerate(self.words):
            if word in switches.CLOSE and open_:
                self.ends[open_.pop()] = i
            self.inside.append(open_[-1] if open_ else -1)
            if word in switches.OPEN:
                open_.append(i)
        self.begins = {end: begin for begin, end in self.ends.items()}

    def offset(self, place):
        return self.lines[place["line"] - 1] + place["column"] - 1

    def span(self, span):
        return self.offset(span["start"]), self.offset(span["end"])

    def at(self, offset):
        """Index of the first token that begins there or later."""
        return bisect.bisect_left(self.starts, offset)

    def whole(self, at):
        """Where the expression that holds a token begins and ends, as offsets.

        Raises NoSwitch.
        """
        around = self.inside[at]
        start = self.statement(at, around)
        end = self.ends.get(around, len(self.words))
        words, here = self.words[start:end + 1], at - start
        begin = switches.left(words, here, here + 1)
        is_head = switches.is_head(words[:here + 1], begin)
        stop = switches.right(words, max(here, begin), is_head)
        if is_head or (begin and words[begin - 1] in {"&&"}):
            begin, stop = between_lets(words, begin, stop, here)
        if stop <= here or switches.in_parameters(words, here):
            raise switches.NoSwitch("no expression")
        return self.tokens[start + begin][1], self.tokens[start + stop - 1][2]

    def statement(self, at, around):
        i = at - 1
        while i > around:
            word = self.words[i]
            if word == ";":
                break
            if word == "}" and self.ends_statement(i):
                break
            i = self.begins[i] - 1 if word in switches.CLOSE else i - 1
        return i + 1

    def in_constant(self, offset):
        """Whether an expression is the value of a constant."""
        at = self.at(offset)
        start = self.statement(at, self.inside[at])
        return "const" in self.words[start:start + 4] and "fn" not in self.words[start:at]

    def constant(self, begin, end, form, number):
        """The constant once more with another value, and where: ((offset, text), ranges of its uses, its name).

        Raises NoSwitch if it is not this file's own.
        """
        at = self.at(begin)
        start = self.statement(at, self.inside[at])
        stop = next(i for i in range(at, len(self.words)) if self.words[i] == ";" and self.inside[i] == self.inside[at])
        if self.words[start] != "const":
            raise switches.NoSwitch("others may use it")
        name = self.words[start + 1]
        other = f"{name}_FAULT_{number}"
        text = self.text[self.tokens[start + 2][1]:begin] + form + self.text[end:self.tokens[stop][2]]
        uses = [(first, last) for i, (word, first, last) in enumerate(self.tokens)
                if word == name and i != start + 1 and self.words[i - 1] not in {"::", ".", "const"}]
        if not uses:
            raise switches.NoSwitch("it is used by another name")
        return (self.tokens[stop][2], f" const {other}{text}"), uses, other

    def ends_statement(self, i):
        gap = self.text[self.tokens[i][2]:self.tokens[i + 1][1]]
        return "\n" in gap and self.words[i + 1] not in GOES_ON


def between_lets(words, begin, stop, here):
    """In a condition with `let`, the part between `&&` that holds a place."""
    if "let" not in words[max(begin - 8, 0):stop]:
        return begin, stop
    depth, cuts = 0, []
    for i in range(begin, stop):
        depth += (words[i] in switches.OPEN) - (words[i] in switches.CLOSE)
        if depth == 0 and words[i] == "&&":
            cuts.append(i)
    return max([begin, *(i + 1 for i in cuts if i < here)]), min([stop, *(i for i in cuts if i > here)])


def site(source, mutant, number):
    """Where a mutant's question stands and what is asked: begin, end, and what stands there instead or, if nothing does, is inserted.

    Raises NoSwitch.
    """
    begin, end = source.span(mutant.span)
    asked = f"contract::fault({number})"
    if mutant.genre == "FnValue" and "impl Iterator" in mutant.function["return_type"]:
        # Types that are not named cannot be chosen between, but nothing can be taken of one, and one thing put behind it.
        once = re.fullmatch(r"::std::iter::once\((.*)\)", mutant.replacement)
        behind = f".chain({asked}.then_some({once[1]}))" if once else ""
        return begin, end, ("let of = { ", f" }}; of.take(if {asked} {{ 0 }} else {{ usize::MAX }}){behind}")
    if mutant.genre == "FnValue":
        return begin, begin, f"if {asked} {{ return {mutant.replacement}; }} "
    if mutant.genre in ("BinaryOperator", "UnaryOperator"):
        first, last = source.whole(source.at(begin))
        return first, last, source.text[first:begin] + mutant.replacement + source.text[end:last]
    if mutant.genre == "MatchArmGuard":
        return begin, end, mutant.replacement
    if mutant.genre == "MatchArm":
        at = source.at(begin)
        depth, guard = 0, None
        while not (depth == 0 and source.words[at] == "=>"):
            depth += (source.words[at] in switches.OPEN) - (source.words[at] in switches.CLOSE)
            if depth == 0 and source.words[at] == "if":
                guard = at
            at += 1
        if guard is not None:
            return source.tokens[guard + 1][1], source.tokens[at - 1][2], "false"
        place = source.tokens[at][1]
        return place, place, f"if !{asked} "
    if mutant.genre == "StructField":
        at = source.at(begin)
        close = source.ends[source.inside[at]]
        rest = next(i for i in range(close - 1, at, -1) if source.words[i] == ".." and source.inside[i] == source.inside[at])
        base = source.text[source.tokens[rest + 1][1]:source.tokens[close - 1][2]].rstrip(", \n")
        field = source.words[at]
        instead = f"({base}).{field}"
        if source.words[at + 1] != ":":
            return source.tokens[at][2], source.tokens[at][2], f": (if {asked} {{ {instead} }} else {{ {field} }})"
        value = source.tokens[at + 2][1]
        return value, source.offset(mutant.span["end"]) - (source.text[end - 1] == ","), instead
    raise switches.NoSwitch(f"of a kind that is not known: {mutant.genre}")


def planted(source, mutants):
    """A file's text with the questions of some mutants, a list of (number, mutant); and those that cannot be asked."""
    insertions, choices, constants, refused = {}, {}, [], []
    for number, mutant in mutants:
        try:
            begin, end, form = site(source, mutant, number)
        except (switches.NoSwitch, StopIteration, IndexError):
            refused.append(mutant)
            continue
        if mutant.genre != "FnValue" and source.in_constant(begin):
            constants.append((number, mutant, begin, end, form))
        elif isinstance(form, tuple):
            for place, inserted in zip((begin, end), form):
                insertions.setdefault(place, []).append(inserted)
        elif begin == end:
            insertions.setdefault(begin, []).append(form)
        else:
            choices.setdefault((begin, end), []).append((number, mutant, form))
    for number, mutant, begin, end, form in constants:
        try:
            after, uses, name = source.constant(begin, end, form, number)
        except (switches.NoSwitch, StopIteration, KeyError):
            refused.append(mutant)
            continue
        insertions.setdefault(after[0], []).append(after[1])
        for range_ in uses:
            choices.setdefault(range_, []).append((number, mutant, name))
    # Ranges that overlap and are not one within the other cannot both be chosen.
    kept, open_ = [], []
    for begin, end in sorted(choices, key=lambda range_: (range_[0], -range_[1])):
        while open_ and open_[-1] <= begin:
            open_.pop()
        if open_ and end > open_[-1]:
            refused += [mutant for _, mutant, _ in choices[begin, end]]
            continue
        open_.append(end)
        kept.append((begin, end))
    text = source.text

    def plain(begin, end):
        """Text that holds no choice. What is inserted where a choice begins stands before it."""
        out, at = [], begin
        for place in sorted(place for place in insertions if begin <= place <= end):
            out += [text[at:place], *insertions.pop(place)]
            at = place
        return "".join([*out, text[at:end]])

    def rendered(begin, end, ranges):
        out, at = [], begin
        while ranges:
            (first, last), ranges = ranges[0], ranges[1:]
            inner = [r for r in ranges if r[1] <= last]
            ranges = ranges[len(inner):]
            arms = [(f"contract::fault({number})", form) for number, _, form in choices[first, last]]
            out += [plain(at, first), switches.chosen(arms, rendered(first, last, inner), "()")]
            at = last
        return "".join([*out, plain(at, end)])

    return rendered(0, len(text), kept), refused


def arms(text):
    """For each question its number, the offsets between which the mutant's own text stands, and where the whole ends."""
    source = Source(text)
    found = [(int(m.group(1)), m.start(), m.end(), m.end()) for m in re.finditer(r"const \w+_FAULT_(\d+)[^;]*;", text)]
    for match in ASKS.finditer(text):
        number, at = int(match.group(1)), source.at(match.end())
        if source.words[at] == "{" and at in source.ends:
            close = last = source.ends[at]
            while source.words[last + 1:last + 2] == ["else"]:
                brace = next(i for i in range(last + 2, len(source.words)) if source.words[i] == "{" and i in source.ends)
                last = source.ends[brace]
            found.append((number, match.start(), source.tokens[close][2], source.tokens[last][2]))
        else:
            found.append((number, match.start(), match.end() + 40, match.end() + 40))
    return found


def blamed(made, texts):
    """Numbers of the mutants that errors are about, with what was said."""
    found, sources, places = {}, {}, {}
    for (message, _), spans in zip(made.errors, made.spans):
        best = None
        for file, (line, column), primary in spans:
            if file not in texts:
                continue
            if file not in sources:
                sources[file], places[file] = Source(texts[file]), arms(texts[file])
            at = sources[file].lines[line - 1] + column - 1
            for number, begin, end, whole in places[file]:
                own = begin - 4 <= at < end
                if own or begin - 4 <= at < whole:
                    rank = (own, primary, -(end if own else whole) + begin)
                    best = max(best, (rank, number)) if best else (rank, number)
        if best:
            found[best[1]] = message
    return found


def replaced(text, mutant):
    """A file's text as cargo-mutants would leave it."""
    begin, end = Source(text).span(mutant.span)
    return text[:begin] + mutant.replacement + text[end:]


def chosen(mutants, words):
    """Those whose file or name matches any of some patterns; all if there are none."""
    return [m for m in mutants if not words or any(fnmatch.fnmatch(m.file, word) or word in m.name for word in words)]
