"""The exception for all errors that the add-on reports."""


class Failure(Exception):
    """A sentence for the panel and for a farm's log: the found value, and the expected value."""
