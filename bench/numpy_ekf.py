"""An extended Kalman filter's covariance step as it is usually written in Python."""
import os
import time

for threads in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(threads, "1")
import numpy as np  # noqa: E402 - the number of its threads is read when it is loaded

STATES, SCALARS = 63, 3


class Filter:
    """Predict and update over dense arrays."""

    def __init__(self):
        self.x = np.zeros(STATES)
        self.P = np.eye(STATES)
        self.Q = np.zeros((STATES, STATES))
        self.one = np.eye(STATES)

    def predict(self, F):
        self.x = F @ self.x
        self.P = F @ self.P @ F.T + self.Q

    def update(self, y, H, R):
        PHT = self.P @ H.T
        K = PHT @ np.linalg.inv(H @ PHT + R)
        self.x = self.x + K @ y
        left = self.one - K @ H
        self.P = left @ self.P @ left.T + K @ R @ K.T


def seconds_of_a_step(steps=400):
    """CPU seconds of two predictions and two updates of three scalars each: accelerometers, then gimbals."""
    draw = np.random.default_rng(1)
    F = np.eye(STATES)
    F[:3, 3:] = 1e-3 * draw.standard_normal((3, STATES - 3))
    H_acc, H_gimbal = 1e-2 * draw.standard_normal((2, SCALARS, STATES))
    R = np.eye(SCALARS)
    y = 1e-3 * draw.standard_normal(SCALARS)
    ekf = Filter()
    start = time.process_time()
    for _ in range(steps):
        ekf.predict(F)
        ekf.update(y, H_acc, R)
        ekf.predict(F)
        ekf.update(y, H_gimbal, R)
    seconds = (time.process_time() - start) / steps
    assert np.isfinite(ekf.P).all()
    return seconds
