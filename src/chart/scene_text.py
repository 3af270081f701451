"""A scene's text with the places of its keys.  An edit changes the values that it names, and nothing else.

The text is not read and written anew, so that comments stay, and numbers that YAML 1.1 and 1.2 read differently.
"""
import yaml

from messages import Refusal

LOADER = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


def flow_text(value):
    """A value in YAML's flow style: text as it is, a map in braces."""
    if not isinstance(value, dict):
        return value
    return "{" + ", ".join(f"{key}: {flow_text(part)}" for key, part in value.items()) + "}"


def true_end(node):
    """Where a node's text ends.  The parser ends a block only where the next token begins."""
    if isinstance(node, yaml.ScalarNode) or node.flow_style:
        return node.end_mark.index
    last = node.value[-1]
    return true_end(last[1] if isinstance(last, tuple) else last)


def children(node):
    """(key, node) of a map's values or a list's items."""
    if isinstance(node, yaml.MappingNode):
        return [(key.value, value) for key, value in node.value]
    return list(enumerate(node.value)) if isinstance(node, yaml.SequenceNode) else []


def nodes(node, path=()):
    """(path, node) of a node and all below it.  What an alias repeats has a path at each place."""
    yield path, node
    for key, part in children(node):
        yield from nodes(part, (*path, key))


def scalars(node, path=()):
    """(path, node) of all values below a node that are neither maps nor lists."""
    if isinstance(node, yaml.ScalarNode):
        yield path, node
    for key, part in children(node):
        yield from scalars(part, (*path, key))


class SceneText:
    def __init__(self, text):
        self.text = text
        self.root = yaml.compose(text, Loader=LOADER)

    def find(self, *path):
        """The node at a path of keys; None where there is none."""
        node = self.root
        for key in path:
            node = next((part for name, part in children(node) if name == key), None)
        return node

    def value(self, *path, default=None):
        """The text of a value; `default` where the key is absent."""
        node = self.find(*path)
        return default if node is None else node.value

    def number(self, *path, default=None):
        text = self.value(*path)
        return default if text is None else float(text)

    def names(self, section):
        node = self.find(section)
        return [] if node is None else [key for key, _ in children(node)]

    def elements(self):
        """{path: number} of all keys `elements` of cables."""
        cables = self.find("cables")
        return {("cables", *path): int(node.value) for path, node in scalars(cables)
                if path[-1] == "elements"} if cables is not None else {}

    def edited(self, values):
        """The text with new values.
        @param values  {path: text}; None takes a key of a map away, and what is absent is added"""
        edits, added = [], {}
        self._check_aliases(values)
        for path, text in values.items():
            if self.find(*path) is not None:
                edits.append(self._replacement(path, text))
            elif text is not None:
                self._add(path, text, added)
        edits += [self._insertion(self.find(*place), keys) for place, keys in added.items()]
        text = self.text
        for start, end, new in sorted(set(edits), reverse=True):
            text = text[:start] + new + text[end:]
        return text

    def _check_aliases(self, values):
        """What is written once and stands at several places can only be changed at all of them."""
        places = {}
        for path, node in nodes(self.root):
            places.setdefault(id(node), []).append(path)
        for path, text in values.items():
            known = next(n for n in range(len(path), -1, -1) if self.find(*path[:n]) is not None)
            for other in places[id(self.find(*path[:known]))]:
                other = (*other, *path[known:])
                if values.get(other, "") != text:
                    raise Refusal(f"{'.'.join(map(str, path))} cannot be changed alone, because an alias repeats it at "
                                  f"{'.'.join(map(str, other))}: write the value out at one of the two")

    def _replacement(self, path, text):
        if text is None:
            return self._removal(path)
        node = self.find(*path)
        end = true_end(node)
        # What stands before a plain word, an anchor, stays.
        plain = isinstance(node, yaml.ScalarNode) and self.text[:end].endswith(node.value)
        return (end - len(node.value) if plain else node.start_mark.index, end, text)

    def _removal(self, path):
        """The part of the text that holds one key of a map, the separator included."""
        pairs = self.find(*path[:-1]).value
        place = next(i for i, (key, _) in enumerate(pairs) if key.value == path[-1])
        start, end = pairs[place][0].start_mark.index, true_end(pairs[place][1])
        if place + 1 < len(pairs):
            end = pairs[place + 1][0].start_mark.index
        elif place:
            start = true_end(pairs[place - 1][1])
        return (start, end, "")

    def _add(self, path, text, added):
        """Puts an absent key into `added`: {path of the map that exists: {key: text or map}}."""
        known = next(n for n in range(len(path) - 1, -1, -1) if self.find(*path[:n]) is not None)
        keys = added.setdefault(path[:known], {})
        for key in path[known:-1]:
            keys = keys.setdefault(key, {})
        keys[path[-1]] = text

    def _insertion(self, node, keys):
        """New keys before a map's first one."""
        if node.flow_style:
            start = self.text.index("{", node.start_mark.index) + 1
            return (start, start, flow_text(keys)[1:-1] + (", " if node.value else ""))
        first = node.value[0][0].start_mark
        lines = [f"{key}: {flow_text(value)}\n" + " " * first.column for key, value in keys.items()]
        return (first.index, first.index, "".join(lines))
