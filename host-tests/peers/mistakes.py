"""What goes wrong through no fault of the program, and is told in one line."""


class Mistake(Exception):
    """Input that cannot be used; the message says what, where, and how to mend it."""
