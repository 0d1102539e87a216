"""The one kind of failure that the add-on tells of: a sentence."""


class Failure(Exception):
    """What was found, and what was expected instead: one sentence for the panel, and for a farm's log."""
