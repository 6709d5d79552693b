"""A ship given by numbers, and its response to three seas as an independent program found it.

That program integrates over the wave variables on a grid of its own (its change on refining: below 3e-5), solves the Gaussian
closure by damped passes to 1e-9, and simulates seas by FFT with 256 hours each. Covariances of (v, phi, p, r) to 1e-3.
"""

import numpy as np

from quartering.motion.equations.model import Model

LENGTH, DRAUGHT, FORCE = 120.0, 4.0, (9.5, -0.9, 0.55, 0.05)
TERMS = {
    "Y_v": -0.055, "Y_phi": 0.012, "Y_p": 0.02, "Y_r": -6.0, "K_v": 0.0045, "K_phi": -0.216, "K_p": -0.065, "K_r": 0.12,
    "N_v": -0.0004, "N_phi": -0.0009, "N_p": 0.004, "N_r": -0.12, "Y_vvv": -0.012, "Y_vrr": -40.0, "K_vvv": 0.0018,
    "K_phiphiphi": -0.15, "K_phi5": 0.12, "K_ppp": -0.05, "K_vvp": -0.004, "K_prr": -2.5, "N_rrr": -30.0, "N_vvr": -0.02,
}  # fmt: skip
MODEL = Model(np.eye(3), TERMS, 1.0, (0, 0, 0), (0, 0, 0))


def force(sigma, heading):
    """Accelerations per metre: of a slender body in the orbital motion, k e^(-kT) sin mu over the length."""
    mu, k = np.radians(heading), sigma**2 / 9.81
    u = 0.5 * k * LENGTH * np.cos(mu)
    across = k * np.exp(-k * DRAUGHT) * np.sin(mu)
    small = np.abs(u) < 1e-3
    safe = np.where(small, 1.0, u)
    even = np.sinc(u / np.pi)
    odd = np.where(small, u / 3.0, (np.sin(safe) - safe * np.cos(safe)) / safe**2)
    f0, f1, f2, f3 = FORCE
    return 1j * np.stack([f0 * even, f1 * even - 1j * f3 * odd, -1j * f2 * odd], axis=1) * across[:, None]


# name: sea, speed; covariances without and with the closure as vv, vphi, vp, vr, phiphi, pp, phir, pr, rr (phip is 0); roll RMS
# simulated, nonlinear [deg] and its standard error; Tz of linear roll; real and imaginary parts of the mean Jacobian's roll
# pair and its two slow modes; mean largest |roll| over RMS of linear roll in 3 h by Vanmarcke and by Rice with every swing
CASES = {
    "long_quartering": (
        {"hs": 5.0, "tp": 10.0, "heading": 45.0}, 8.0,
        (0.351598559235, -0.0596497134859, 0.0473726937915, -8.70859075071e-05, 0.060732116674, 0.00999625395151,
         0.00323034294827, 0.000736647019079, 0.000284527754857),
        (0.307732767642, -0.0405873906804, 0.0378516495439, -5.67017021065e-06, 0.0379707485026, 0.00622353077558,
         0.00255358372393, 0.00047276227516, 0.000263795153217),
        (11.4853356381, 0.0483270240627), 15.4871119198, (-0.033454569645, 0.47860638792, -0.0506523159586, -0.176788898227),
        (3.26245, 3.95706),
    ),
    "short_quartering": (
        {"hs": 2.5, "tp": 10.0, "heading": 60.0, "spreading": 8}, 8.0,
        (0.0908136981469, -0.027190968743, -0.0070027333434, -8.70747330549e-05, 0.0325449995672, 0.00768673823816,
         6.35470138948e-05, 0.000261704792113, 4.30471975105e-05),
        (0.0895033577134, -0.0272103302889, -0.00596633422564, -8.13212205894e-05, 0.0321608808781, 0.00793239048076,
         0.000107513940656, 0.000259770451774, 4.29697293808e-05),
        (10.209000032, 0.0361246775676), 12.9285838787, (-0.0328791051522, 0.4766290597, -0.0327942768116, -0.153701062062),
        (3.69003, 4.00236),
    ),
    "long_beam": (
        {"hs": 3.5, "tp": 10.0, "heading": 90.0}, 0.0,
        (0.223022810021, -0.0167310717808, -0.0385904761299, -0.000193045397322, 0.0254047490834, 0.00915836928328,
         0.000124375722916, 3.10969322127e-05, 7.47231142962e-07),
        (0.222700852838, -0.0204597810022, -0.0395996123506, -0.000209372538904, 0.0287883663963, 0.0103288491139,
         0.000136014214697, 3.48342055294e-05, 7.94371929524e-07),
        (9.74743086265, 0.0260659619871), 10.4647353035, (-0.0332488408739, 0.475409001827, -0.0349433946761, -0.153575556394),
        (3.85756, 4.05477),
    ),
}  # fmt: skip


def matrix(entries):
    """Covariance (4, 4) from the entries as listed."""
    vv, vf, vp, vr, ff, pp, fr, pr, rr = entries
    return np.array([[vv, vf, vp, vr], [vf, ff, 0.0, fr], [vp, 0.0, pp, pr], [vr, fr, pr, rr]])
