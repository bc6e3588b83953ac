# Functions of numpy that controllers use, one after the other, on numbers, vectors and matrices.
import numpy as np
from numpy import array, cos, pi, sin

V = np.array([1.0, -2.0, 3.0])
W = np.array([0.5, 0.25, -1.0])
M = np.array([[2.0, 1.0, 0.5], [0.0, 3.0, 1.0], [1.0, 0.0, 4.0]])


def forward_kinematics(robot, q):
    made = [np.array([1, 2]), np.array([[1, 2], [3, 4]]), np.array([1.0, 2]), np.array((1, 2), dtype=float), np.zeros(3)]
    made += [np.zeros((2, 3)), np.ones(2), np.ones((2, 2)), np.eye(3), np.identity(2), np.full(2, 0.5), np.arange(3)]
    made += [np.arange(0, 1, 0.5), np.linspace(0, 1, 5), np.diag([1, 2]), np.diag(M), np.zeros_like(V), np.ones_like(V)]
    made += [np.asarray([1, 2]), np.asarray(V), np.copy(V), V.copy(), np.concatenate([V, W]), np.concatenate((V, [1]))]
    made += [np.append(V, 1), np.hstack([V, W]), np.vstack([V, W]), np.stack([V, W]), np.column_stack([V, W]), np.empty(2)]
    made += [V.reshape(3, 1), V.reshape((1, 3)), M.reshape(-1), M.flatten(), M.ravel(), np.array(list(V)), V[:, None]]
    made += [np.array([V, W]), np.array([]), np.float64(1), np.outer(V, W), np.block([[np.eye(2), np.zeros((2, 1))]]), np.tile(V, 2)]
    T = np.eye(4)
    T[:3, :3] = M
    T[:3, 3] = V
    T[0, 0] = 1
    T[3] = [0, 0, 0, 1]
    T[1, :] = 0
    return T[:3, 3] + sum(len(np.atleast_1d(m)) for m in made)


def inverse_kinematics(robot, position):
    x = 0.3
    of_one = [np.sin(x), np.cos(x), np.tan(x), np.arcsin(x), np.arccos(x), np.arctan(x), np.sqrt(x), np.exp(x), np.log(x)]
    of_one += [np.abs(-x), np.absolute(x), np.sign(x), np.floor(x), np.ceil(x), np.round(x, 2), np.square(x), np.radians(x)]
    of_one += [np.deg2rad(x), np.rad2deg(x), np.degrees(x), np.tanh(x), np.isnan(x), np.isfinite(x), np.fabs(x), sin(x), cos(x)]
    of_each = [np.sin(V), np.cos(V), np.sqrt(np.abs(V)), np.exp(V), np.abs(V), np.sign(V), np.round(V, 2), np.square(V)]
    of_each += [np.deg2rad(V), np.arctan2(V, W), np.arctan2(1.0, 2), np.hypot(V, W), np.maximum(V, W), np.minimum(V, 0), np.tanh(V)]
    of_each += [np.clip(V, -1, 1), np.clip(0.5, 0, 1), V.clip(-1, 1), np.where(V > 0, V, W), np.mod(V, 2), np.power(V, 2), np.unwrap(V)]
    of_each += [V + W, V - W, V * W, V / W, V**2, V % 2, V // 2, -V, +V, abs(V), V + 1, 1 + V, V - 1, 1 - V, V * 2, 2 * V]
    of_each += [V / 2, 1 / V, V + [1, 2, 3], [1, 2, 3] + V, V * 0.5, 0.5 * V, V + M, M * 2, M + M, M - 1, M / 2, -M, M * V]
    of_each += [V @ W, M @ V, M @ M, V @ M, M.T, M.T @ V, np.dot(V, W), np.dot(M, V), M.dot(V), V.dot(W), np.matmul(M, M), np.vdot(V, W)]
    of_each += [np.cross(V, W), np.inner(V, W), np.transpose(M), np.trace(M), np.interp(0.5, [0, 1], [1, 2]), np.diff(V), np.cumsum(V)]
    of_all = [np.sum(V), V.sum(), M.sum(axis=0), np.sum(M, axis=1), np.mean(V), V.mean(), np.max(V), V.max(), np.min(V), V.min()]
    of_all += [np.argmax(V), V.argmax(), np.argmin(V), np.prod(V), np.std(V), np.any(V > 0), np.all(V > 0), (V > 0).any(), (V > 0).all()]
    of_all += [np.allclose(V, W), np.isclose(1, 1), np.array_equal(V, W), np.median(V), np.argsort(V), np.sort(V), np.nonzero(V)]
    of_all += [np.linalg.norm(V), np.linalg.norm(V - W), np.linalg.norm(M), np.linalg.norm(M, axis=1), np.linalg.det(M), np.linalg.inv(M)]
    of_all += [np.linalg.solve(M, V), np.linalg.pinv(M), np.linalg.pinv(M[:2]), np.linalg.matrix_rank(M), np.linalg.lstsq(M, V, rcond=None)[0]]
    of_all += [V < W, V <= 1, V > W, V >= 0, V == W, V != 1, (V > 0) & (W > 0), (V > 0) | (W > 0), ~(V > 0), np.pi, np.inf, np.nan]
    return [[float(of_one[0]), float(V[0])], [len(of_each), len(of_all)]]


def jacobian(robot, q):
    taken = [V[0], V[-1], V[1:], V[:2], V[::-1], V[1:].copy(), M[0], M[0, 1], M[:, 0], M[0, :], M[:2, :2], M[1:, 1], M[:, 1:], M[-1]]
    taken += [V[[0, 2]], V[V > 0], M[0][1], V.shape, M.shape[0], V.size, V.ndim, V.dtype, V.tolist(), V.astype(int), len(M), float(V[0])]
    taken += [int(V[0]), list(V), tuple(V), [v for v in V], [row[0] for row in M], str(V), repr(V), str(M), f"{V}", f"{V[0]:.2f}", bool(V[0] > 0)]
    taken += [V[0] + 1, V[0] * V[1], 2 * V[0], -V[0], V[0] ** 2, V[0] / 2, V[0] < 1, V[0] == 1, abs(V[0]), round(V[0], 2), max(V), min(V[0], 1)]
    taken += [sum(V), max(V[0], V[1]), sorted(V), any(V > 0), np.float64(2) + 1, 1 - np.float64(2), isinstance(V, np.ndarray), V.item(0), V is None]
    own = V.copy()
    own[0] = 1
    own[1:] = [1, 2]
    own[:2] += 1
    own[own > 1] = 0
    own += W
    own -= W
    own *= 2
    own /= 2
    own += 1
    own[-1] -= 0.5
    x, y, z = own
    x, y = own[:2]
    first, *rest = own
    for i, value in enumerate(own):
        own[i] = value + i
    for a, b in zip(V, W):
        x += a * b
    print(taken, own, V, M, np.round(V, 2))
    for broken in (lambda: V + np.zeros(2), lambda: M @ np.zeros(2), lambda: V[5], lambda: np.array([1, [2, 3]]), lambda: V.q):
        try:
            broken()
        except (ValueError, IndexError, AttributeError):
            pass
    np.set_printoptions(precision=3, suppress=True)
    return np.array([[x, y], [z, 0], [sin(0.5) * pi, array([1.0])[0]]])


def init(robot, task):
    pass


def control(observation):
    q = observation.q
    q = q + observation.qd * observation.dt - np.array([0.1, 0.2])
    if observation.tick == 39:
        return q[7]
    return q.tolist() if observation.tick % 2 else q
