"""What goes wrong through no fault of the program, and is told in one line."""


class Mistake(Exception):
    """Input that cannot be used; the message says what, where, and how to mend it."""


class Refused(Mistake):
    """What the program would not do with what it was given; the message is its own."""
