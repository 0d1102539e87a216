"""The exception for all errors that the add-on reports: a sentence."""


class Failure(Exception):
    """What was found, and what was expected: a sentence for the panel, and for a farm's log."""
