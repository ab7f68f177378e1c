"""Writes many mutants into one source, each behind a switch that a test process sets, so that one build serves them all.

An operator `a + b` with the mutants 7 (`-`) and 8 (`*`) becomes
`(match (a, b) { (l, r) => match ::mutation::active() { 7 => l - r, 8 => l * r, _ => l + r } })`. Without a switch set, a
file does what it did. What cannot be switched (a constant, a field left out) comes back as not written, and is built alone.
"""

import tree_sitter
import tree_sitter_rust

PARSER = tree_sitter.Parser(tree_sitter.Language(tree_sitter_rust.language()))
ACTIVE = "::mutation::active()"
COMPARISONS = {"==", "!=", "<", ">", "<=", ">="}
LOGICAL = {"&&", "||"}
# Around what is computed by the compiler, or is no expression to the parser.
CONSTANT = {"const_item", "static_item", "const_block", "const_parameter", "type_arguments", "array_type", "token_tree"}


def offsets(text, span):
    """Byte positions of a span of cargo-mutants, whose lines and columns count from 1, in characters."""
    lines = text.splitlines(keepends=True)
    ends = []
    for place in (span["start"], span["end"]):
        before = "".join(lines[: place["line"] - 1]) + lines[place["line"] - 1][: place["column"] - 1]
        ends.append(len(before.encode()))
    return tuple(ends)


def chain(cases, otherwise):
    """`match active { id => text, ..., _ => otherwise }`."""
    arms = ", ".join(f"{number} => {text}" for number, text in cases)
    return f"match {ACTIVE} {{ {arms}, _ => {otherwise} }}"


class Source:
    """One file and the mutants to be written into it: (number, mutant of cargo-mutants)."""

    def __init__(self, text, mutants, functions=()):
        self.bytes = text.encode()
        self.root = PARSER.parse(self.bytes).root_node
        self.sites = {}  # node id -> [(number, mutant)]
        self.tables = {}  # node id of a static -> [(number, mutant)]
        self.hits = {}  # node id of a function's body -> [number of the function]
        self.left = []
        for number, mutant in mutants:
            node = self.place(mutant, *offsets(text, mutant["span"]))
            if node is None:
                self.left.append(number)
            elif node.type == "static_item":
                self.tables.setdefault(node.id, []).append((number, mutant))
            else:
                self.sites.setdefault(node.id, []).append((number, mutant))
        for number, span in functions:
            body = self.body_at(*offsets(text, span))
            if body is not None:
                self.hits.setdefault(body.id, []).append(number)

    def source(self, node):
        return self.bytes[node.start_byte : node.end_byte].decode()

    def body_at(self, start, end):
        """The body of the function that a span covers, unless it is `const`."""
        node = self.root.descendant_for_byte_range(end - 1, end)
        while node is not None and node.type != "function_item":
            node = node.parent
        return None if node is None or self.is_const(node) else node.child_by_field_name("body")

    def is_const(self, function):
        return any(child.type == "function_modifiers" and "const" in self.source(child) for child in function.children)

    def place(self, mutant, start, end):
        """The node whose text depends on the switch of this mutant; none if no switch can be there."""
        node = self.root.descendant_for_byte_range(start, end)
        genre = mutant["genre"]
        if genre == "FnValue":
            while node is not None and node.type != "function_item":
                node = node.parent
            return None if node is None or self.is_constant(node) else node.child_by_field_name("body")
        if genre in ("BinaryOperator", "UnaryOperator"):
            wanted = ("binary_expression", "compound_assignment_expr") if genre == "BinaryOperator" else ("unary_expression",)
            node = self.root.descendant_for_byte_range(start, start + 1).parent
            if node is None or node.type not in wanted or self.operator(node).start_byte != start:
                return None
        elif genre in ("MatchArm", "MatchArmGuard"):
            while node is not None and node.type != "match_arm":
                node = node.parent
            if node is None:
                return None
        else:
            return None
        table = self.is_constant(node)
        if table is not None and table.type == "static_item" and table.parent.type == "source_file":
            return table
        return None if table is not None else node

    def operator(self, node):
        return node.child_by_field_name("operator") or node.children[0 if node.type == "unary_expression" else 1]

    def is_constant(self, node):
        """The item around a node that the compiler computes, if there is one."""
        while node is not None:
            if node.type in CONSTANT:
                return node
            if node.type == "function_item":
                return node if self.is_const(node) else None
            node = node.parent
        return None

    def text(self):
        return self.render(self.root)

    def between(self, node, changed=()):
        """The text of a node, its children rendered, or replaced by what `changed` says."""
        out, position = [], node.start_byte
        for child in node.children:
            out.append(self.bytes[position : child.start_byte].decode())
            out.append(dict(changed).get(child.id) or self.render(child))
            position = child.end_byte
        out.append(self.bytes[position : node.end_byte].decode())
        return "".join(out)

    def render(self, node):
        sites = self.sites.get(node.id)
        if node.type == "static_item" and node.id in self.tables:
            return self.table(node, self.tables[node.id])
        if node.type == "block" and (sites or node.id in self.hits):
            return self.body(node, sites or [])
        if not sites:
            return self.between(node)
        if node.type == "binary_expression":
            return self.binary(node, sites)
        if node.type == "compound_assignment_expr":
            return self.assignment(node, sites)
        if node.type == "unary_expression":
            operand = self.render(node.children[1])
            same = f"{self.source(node.children[0])}__x"
            return f"(match {operand} {{ __x => {chain([(number, '__x') for number, _ in sites], same)} }})"
        return self.arm(node, sites)

    def binary(self, node, sites):
        left, right = self.render(node.child_by_field_name("left")), self.render(node.child_by_field_name("right"))
        operator = self.source(self.operator(node))
        new = [(number, mutant["replacement"]) for number, mutant in sites]
        if operator in LOGICAL:
            return "(" + chain([(number, f"(({left}) {other} ({right}))") for number, other in new], f"(({left}) {operator} ({right}))") + ")"
        if operator in COMPARISONS:
            cases = [(number, f"*__l {other} *__r") for number, other in new]
            return f"(match (&({left}), &({right})) {{ (__l, __r) => {chain(cases, f'*__l {operator} *__r')} }})"
        cases = [(number, f"__l {other} __r") for number, other in new]
        return f"(match ({left}, {right}) {{ (__l, __r) => {chain(cases, f'__l {operator} __r')} }})"

    def assignment(self, node, sites):
        left, right = self.render(node.child_by_field_name("left")), self.render(node.child_by_field_name("right"))
        cases = [(number, f"{{ {left} {mutant['replacement']} __r; }}") for number, mutant in sites]
        return f"(match {right} {{ __r => {chain(cases, f'{{ {left} {self.source(self.operator(node))} __r; }}')} }})"

    def body(self, node, sites):
        start = "".join(f" ::mutation::hit({number});" for number in self.hits.get(node.id, []))
        start += "".join(f" if {ACTIVE} == {number} {{ return {mutant['replacement']}; }}" for number, mutant in sites)
        inside = self.between(node)
        return "{" + start + inside[1:]

    def arm(self, node, sites):
        pattern = node.child_by_field_name("pattern")
        guard = pattern.child_by_field_name("condition")
        gone = [number for number, mutant in sites if mutant["genre"] == "MatchArm"]
        forced = [(number, mutant["replacement"]) for number, mutant in sites if mutant["genre"] == "MatchArmGuard"]
        old = f"({self.render(guard)})" if guard is not None else "true"
        condition = f"({chain(forced, old)})" if forced else old
        condition = " && ".join([f"{ACTIVE} != {number}" for number in gone] + [condition])
        if guard is not None:
            inside = self.between(pattern, {guard.id: condition}.items())
        else:
            inside = f"{self.render(pattern)} if {condition}"
        return self.between(node, {pattern.id: inside}.items())

    def table(self, node, sites):
        """A static, its mutants beside it, and `pick_NAME`, which tells them apart; see [`use_tables`]."""
        name, text = self.source(node.child_by_field_name("name")), self.source(node)
        kind = self.source(node.child_by_field_name("type"))
        copies, cases = [], []
        for number, mutant in sites:
            start, end = (place - node.start_byte for place in offsets(self.bytes.decode(), mutant["span"]))
            raw = text.encode()
            changed = (raw[:start] + mutant["replacement"].encode() + raw[end:]).decode()
            copies.append(changed.replace(f"static {name}:", f"static {name}_{number}:", 1))
            cases.append((number, f"&{name}_{number}"))
        pick = f"pub fn pick_{name}() -> &'static {kind} {{ {chain(cases, f'&{name}')} }}"
        return "\n".join([text, *copies, pick])


def table_names(text, mutants):
    """Names of the statics of a file that hold mutants."""
    source = Source(text, mutants)
    found, nodes = [], [source.root]
    while nodes:
        node = nodes.pop()
        if node.id in source.tables:
            found.append(source.source(node.child_by_field_name("name")))
        nodes.extend(node.children)
    return found


def use_tables(text, names):
    """Every `&NAME` of a file by the function that picks; `names` maps a static to the path of its module."""
    for name, module in names.items():
        text = text.replace(f"&{name})", f"{module}::pick_{name}())")
    return text
