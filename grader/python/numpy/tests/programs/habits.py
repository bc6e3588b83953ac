# pieces of programs as students write them
| def forward(q, lengths):
|     x = y = 0.0
|     angle = 0.0
|     for i in range(len(q)):
|         angle += q[i]
|         x += lengths[i] * np.cos(angle)
|         y += lengths[i] * np.sin(angle)
|     return np.array([x, y])
forward(np.array([0.1, 0.2]), [1, 0.5])
| def rotation(a):
|     c, s = np.cos(a), np.sin(a)
|     return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
| T = np.eye(3)
| for a in [0.1, 0.2, 0.3]:
|     T = T @ rotation(a)
|     T[0, 2] += 1
T
| class Controller:
|     def __init__(self):
|         self.kp = np.diag([10, 20])
|         self.ki = np.array([1.0, 2])
|         self.integral = np.zeros(2)
|     def step(self, error, dt):
|         error = np.asarray(error)
|         self.integral += error * dt
|         u = self.kp @ error + self.ki * self.integral
|         return np.clip(u, -1.5, 1.5)
| c = Controller()
| out = [c.step((0.01, -0.2), 0.1) for _ in range(5)]
np.array(out)
| x = np.array([1.0, 0])
| A = np.array([[0, 1], [-1, -0.1]])
| for _ in range(100):
|     x = x + 0.01 * A @ x
x
| def f(x):
|     return np.array([x[0] ** 2 + x[1] - 3, x[0] - x[1] + 1])
| def jacobian(x, h=1e-6):
|     J = np.zeros((2, 2))
|     for i in range(2):
|         d = np.zeros(2)
|         d[i] = h
|         J[:, i] = (f(x + d) - f(x - d)) / (2 * h)
|     return J
| x = np.array([1.0, 1.0])
| for _ in range(8):
|     x -= np.linalg.solve(jacobian(x), f(x))
x
| t = np.linspace(0, 1, 11)
| s = 10 * t ** 3 - 15 * t ** 4 + 6 * t ** 5
| q = np.outer(1 - s, [0, 1]) + np.outer(s, [1, 3])
q
| path = np.array([[0, 0], [1, 0], [1, 1]])
| steps = np.diff(path, axis=0)
| lengths = np.sqrt((steps ** 2).sum(axis=1))
lengths, np.concatenate([[0], np.cumsum(lengths)])
| a = np.array([0.1, 3.2, -3.3])
(a + np.pi) % (2 * np.pi) - np.pi
| P = np.eye(2)
| F = np.array([[1, 0.1], [0, 1]])
| H = np.array([[1.0, 0]])
| x = np.array([[0.0], [1.0]])
| for z in [0.1, 0.22, 0.28]:
|     x = F @ x
|     P = F @ P @ F.T + 0.01 * np.eye(2)
|     S = H @ P @ H.T + 0.1
|     K = P @ H.T @ np.linalg.inv(S)
|     x = x + K @ (z - H @ x)
|     P = (np.eye(2) - K @ H) @ P
x, P
| q = np.array([1.0, 2.0, 3.0])
| q[0], q[2] = q[2], q[0]
q
| points = []
| for i in range(3):
|     points.append([i, i ** 2])
| points = np.array(points)
points[:, 1].max(), points.mean(axis=0), points[points[:, 1] > 0]
| def skew(w):
|     return np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
| w = np.array([0, 0, 1])
| th = 0.5
| R = np.eye(3) + np.sin(th) * skew(w) + (1 - np.cos(th)) * skew(w) @ skew(w)
R, np.allclose(R @ R.T, np.eye(3)), round(np.linalg.det(R), 9)
| history = np.zeros((3, 2))
| state = np.array([1, 0])
| for k in range(3):
|     history[k] = state
|     state = state + np.array([0, 1])
history
| y, x = 1, -1
np.degrees(np.arctan2(y, x)), math.degrees(math.atan2(y, x))
| total = 0
| for a, b in zip([1, 2], np.array([3.0, 4])):
|     total += a * b
total
| q = np.array([3, 1])
| q = q / np.sum(q)
q, q.dtype == float, q.shape == (2,)
| a = np.zeros(3)
| b = a
| b[0] = 1
| c = a.copy()
| c[1] = 1
a, c
| def clamp(v, low, high):
|     return max(low, min(high, v))
| a = np.array([5.0, -5])
[clamp(v, -1, 1) for v in a]
| with np.errstate(divide="ignore"):
|     x = np.array([1.0]) / 0
x
| d = {"a": np.array([1, 2])}
| d["a"] = d["a"] * 2
d["a"]
| weights = {i: np.float64(i) for i in range(3)}
sum(weights.values())
| x = np.array([1, 2, 3], dtype=float)
| x[x > 1.5] *= -1
x
| A = np.array([[1, 2], [3, 4]])
| A[[0, 1]] = A[[1, 0]]
A
| from numpy import array, pi, sin
| from numpy.linalg import norm
sin(array([pi / 2])), norm(array([3, 4]))
| import numpy
numpy.array([1]) + numpy.ones(1)
| v = np.array([1, 2, 3])
v.dot(v) ** 0.5, np.sqrt(v @ v), (v * v).sum()
| best = None
| for i, row in enumerate(np.array([[3, 1], [0, 5]])):
|     if best is None or row.min() < best[1]:
|         best = (i, row.min())
best
| grid = np.zeros((3, 3), dtype=int)
| grid[1, 1] = 1
| free = np.argwhere(grid == 0)
len(free), grid.sum(), (grid == 0).sum()
| a = np.array([1.0, 2.0])
| a = np.append(a, 3)
| a = np.vstack((a, a))
a
| T = np.block([[np.eye(2), np.array([[1], [2]])], [np.zeros((1, 2)), 1]])
T @ [0, 0, 1]
| x0, *rest = np.array([1, 2, 3])
x0, rest
| q = np.array([0.5, 0.6])
| print_text = f"q = {q[0]:.3f}, {q[1]:.3f}"
print_text
isinstance(np.array([1.0]).sum(), float), isinstance(np.array([1]).max(), (int, np.integer))
round(np.array([1.2345]).sum(), 2), abs(np.array([-1.5])[0]), int(np.array([2.7])[0])
[0] * 3 + list(np.array([1])), [1, 2][np.array([0, 1])[1]]
list(range(np.array([1, 3])[1]))
np.array([1, 2, 3])[np.int64(1)], np.arange(np.int64(3))
# odds and ends
round(np.array([1.234, 2.345]), 2)
pow(np.array([1, 2]), 2), pow(2, np.array([1, 2]))
a = np.array([1, 2]); (a is not None, type(a).__name__, isinstance(a, list), a.size > 0, a.shape[0])
r, c = np.zeros((2, 3)).shape; (r, c)
max(np.array([1, -3, 2]), key=abs), sum(np.array([1, 2]), 10), min(np.array([3.5, 2]))
a = np.array([1, 2]); b = np.array([3.0, 4]); np.sum([a, b], axis=0), np.mean([a, b], axis=0), np.array([a, b, a + b])
a = np.array([1, 2]); {"x": a}["x"] is a
{np.array([1]): 2}
[np.array([1, 2])] == [np.array([1, 2])]
np.array([1, 2]) in [np.array([1, 2])]
[1, 2] == np.array([1, 2])
np.array([1, 2]) == (1, 2)
np.array([[1, 2], [3, 4]]) == [1, 2]
np.array([1, 2]).__len__(), np.array([1, 2]).__getitem__(1), np.array([1, 2]).__add__(1)
np.ndarray.sum(np.array([1, 2]))
np.array([f(0.5) for f in (math.sin, math.cos, abs)])
np.array(list(map(float, ["1", "2.5"])))
np.array([x for x in range(3) if x])
print_list = list(np.linspace(0, 1, 3)); print_list
a = np.array([1, 2, 3]); a[0], a[1] = a[1], a[0]; a
a = np.array([[1, 2], [3, 4]]); a[[0, 1]] = a[[1, 0]]; a
a = np.array([1.0, 2]); a.T @ a, a[:, None] @ a[None, :]
np.array([1, 2]).real
a = np.array([3.0, 1]); s = sorted(a, reverse=True); s
np.array([[0.5]]) @ np.array([2.0])
np.array([1, 2, 3]).mean().is_integer()
np.round(np.array([0.1 + 0.2, 1 / 3]), 3).tolist()
np.array([1, 2]) * [[1], [2]]
np.sqrt(sum(x ** 2 for x in np.array([3, 4])))
abs(np.array([1, -1]) @ np.array([2, 5]))
math.hypot(*np.array([3.0, 4.0]))
"{:.2f} {:.1f}".format(*np.array([1.234, 5.678]))
", ".join(str(x) for x in np.array([1.5, 2]).tolist())
", ".join(f"{x:.3f}" for x in np.array([1.5, 2]))
np.any(np.abs(np.array([0.1, 2])) > 1), np.all(np.abs([0.1, 2]) < 3)
np.where(np.abs(np.array([1.0, -5])) > 2, np.sign([1.0, -5]) * 2, [1.0, -5])
np.minimum(np.maximum([-5, 0.5, 5], -1), 1)
np.linalg.norm(np.array([[0, 0], [3, 4]])[1] - np.array([[0, 0], [3, 4]])[0])
np.allclose(np.linalg.inv(np.array([[2.0, 1], [1, 3]])) @ np.array([[2.0, 1], [1, 3]]), np.eye(2))
np.arctan2(*np.array([1.0, 1.0])), np.arctan2(*[1, 0])
np.full(2, 3.0) is None, np.zeros(2).any(), not np.zeros(1)
np.float64(1.5) == 1.5, np.int64(3) + 1, float(np.float64(2)), str(float(np.float64(0.1)))
import math as m; m.pi + np.pi
np.array([1, 2, 3], dtype=float).tolist()
np.zeros((3, 3))[1:, 1:].shape, np.zeros((3, 3))[np.ix_] if False else 0
a = np.zeros(3); a[[True, False, True]] = 1; a
a = np.arange(3); a[a == 1] += 5; a
a = np.zeros((2, 2)); a[1] += np.array([1, 2]); a[:, 1] *= 2; a
a = np.arange(4.0); a[1:3] /= 2; a
a = np.arange(4.0); a[::2] -= [1, 2]; a
a = np.array([1, 2]); a = a.astype(float); a += 0.5; a
a = np.array([5, 3]); a, b = divmod(a, 2); (a, b)
x = np.array([1.0]); x[0] += 1; x
