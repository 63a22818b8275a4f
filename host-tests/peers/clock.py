"""Time that an answer may take."""

import time


class Clock:
    """So many seconds from now."""

    def __init__(self, seconds, now=time.perf_counter):
        self.now = now
        self.end = now() + seconds

    def left(self):
        """The seconds that are left."""
        return self.end - self.now()

    def over(self):
        """Whether none is left."""
        return self.left() <= 0

    def part(self, share):
        """A clock with a share of what is left."""
        return Clock(share * self.left(), self.now)
