"""What is seen of a cause once the numbers that may be off are projected out.

Residuals r and changes of residuals D (a column a parameter of the cause, at its typical size), all whitened; N the changes
by the nuisance numbers, with a row of the identity below for their prior z ~ N(0, 1), and zeros below r and D:

    min over z, a of |r + N z + D a|² + |z|²  =  |P r|² - what the amplitudes a take,  P = 1 - Q Q^T,  N = Q R

Frisch, Waugh, Econometrica 1, 1933; Golub, Van Loan, Matrix Computations, 2013, ch. 5 and 6. Amplitudes keep the bounds of
their parameters.
"""

import numpy as np
from scipy.optimize import lsq_linear


class Projection:
    """Takes out of whitened residuals what nuisance numbers explain, at the price of their prior."""

    def __init__(self, nuisance, prior=True):
        self.rows = nuisance.shape[1] if prior else 0
        self.basis, _ = np.linalg.qr(np.vstack([nuisance, np.eye(self.rows)]) if prior else nuisance)

    def out(self, values, below=None):
        """What is left of vectors or of columns; `below` is what they have in the rows of the prior."""
        if self.rows:
            rows = np.zeros((self.rows, *values.shape[1:])) if below is None else below
            values = np.concatenate([values, rows])
        return values - self.basis @ (self.basis.T @ values)


def amplitudes(residual, changes, low, high):
    """The amplitudes within bounds that take most of a projected residual, and how much of its square they take."""
    found = lsq_linear(changes, -residual, (low, high), method="bvls")
    return found.x, float(residual @ residual - 2 * found.cost)


def shares(criteria):
    """Probabilities of models from their criteria: exp(-BIC/2), of sum 1 (Raftery, Sociological Methodology 25, 1995)."""
    lowest = min(criteria)
    weights = np.exp(-0.5 * (np.asarray(criteria) - lowest))
    return weights / weights.sum()
