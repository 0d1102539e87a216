"""The lines of a text in a narrow panel. Needs no Blender."""


def _pieces(word, width, measure):
    """The word itself, or its parts where it is wider than a line."""
    while len(word) > 1 and measure(word) > width:
        end = next((end for end in range(len(word) - 1, 1, -1) if measure(word[:end]) <= width), 1)
        yield word[:end]
        word = word[end:]
    yield word


def lines_of(text, width, measure):
    """The text in lines that are not wider than `width`; `measure` gives the width of a text."""
    lines = [""]
    for word in text.split():
        first, *rest = _pieces(word, width, measure)
        if not lines[-1] or measure(f"{lines[-1]} {first}") <= width:
            lines[-1] = f"{lines[-1]} {first}".strip()
        else:
            lines.append(first)
        lines.extend(rest)
    return lines
