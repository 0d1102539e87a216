"""Settings of one pass, restored after the pass."""


class Changes:
    """Sets attributes and keeps their old values: `with Changes() as changes: changes.set(thing, "x", 1)`."""

    def __init__(self):
        self._undo = []

    def __enter__(self):
        return self

    def __exit__(self, *_):
        while self._undo:
            self._undo.pop()()

    def set(self, thing, name, value):
        before = getattr(thing, name)
        setattr(thing, name, value)
        self._undo.append(lambda: setattr(thing, name, before))

    def afterwards(self, undo):
        self._undo.append(undo)
