"""Attitudes of bodies as rows of unit quaternions (w, x, y, z), body axes to global ones."""
import numpy as np


def product(p, q):
    """p q, the turn q followed by p."""
    p, q = np.broadcast_arrays(p, q)
    w = p[..., :1] * q[..., :1] - (p[..., 1:] * q[..., 1:]).sum(axis=-1, keepdims=True)
    v = p[..., :1] * q[..., 1:] + q[..., :1] * p[..., 1:] + np.cross(p[..., 1:], q[..., 1:])
    return np.concatenate([w, v], axis=-1)


def inverse(q):
    return np.asarray(q) * [1, -1, -1, -1]


def turned(q, v):
    """v, which is given in body axes, in global axes."""
    q, v = np.asarray(q), np.asarray(v)
    twice = 2 * np.cross(q[..., 1:], v)
    return v + q[..., :1] * twice + np.cross(q[..., 1:], twice)


def about(axis, angle):
    """The quaternion of a turn about an axis."""
    axis, angle = np.asarray(axis, dtype=float), np.asarray(angle, dtype=float)
    half = angle[..., None] / 2
    return np.concatenate([np.cos(half), np.sin(half) * axis / np.linalg.norm(axis)], axis=-1)


def matrix(q):
    return np.column_stack([turned(q, axis) for axis in np.eye(3)])


def angle_between(p, q):
    """The angle of the turn from p to q [rad], which is the same for -q."""
    return 2 * np.linalg.norm(product(inverse(p), q)[..., 1:], axis=-1).clip(max=1)


def pitch(q):
    """The pitch of q [deg], where yaw comes first, then pitch, then roll."""
    return np.degrees(np.arcsin(np.clip(2 * (q[..., 0] * q[..., 2] - q[..., 1] * q[..., 3]), -1, 1)))


def six(inertia):
    """A matrix of inertia as a scene has it: Ixx Iyy Izz Ixy Iyz Izx.  Ixy is the integral of x y dm, and so on."""
    i, j = [0, 1, 2, 0, 1, 2], [0, 1, 2, 1, 2, 0]
    return (np.asarray(inertia)[i, j] * [1, 1, 1, -1, -1, -1]).tolist()


class Turning:
    """The attitude `q` and the angular velocity `w` (body axes) of a body in all rows of a run."""

    def __init__(self, run, name):
        self.time = run["time"]
        self.q = np.column_stack([run[f"{name}.q{axis}"] for axis in "wxyz"])
        self.w = np.column_stack([run[f"{name}.w{axis}"] for axis in "xyz"])

    def angular_momentum(self, inertia):
        """The angular momentum about the centre of gravity, in global axes.  @param inertia  a matrix, body axes"""
        return turned(self.q, self.w @ np.asarray(inertia))

    def energy(self, inertia):
        return ((self.w @ np.asarray(inertia)) * self.w).sum(axis=1) / 2

    def off_unit(self):
        return np.abs(np.linalg.norm(self.q, axis=1) - 1).max()
