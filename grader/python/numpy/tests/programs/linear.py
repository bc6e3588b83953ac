# linear algebra
np.linalg.solve([[2, 1], [1, 3]], [3, 5])
np.linalg.solve([[2.0, 1], [1, 3]], np.array([[3, 1], [5, 0]]))
np.linalg.solve([[0, 1], [1, 0]], [2, 3])
np.linalg.solve(np.diag([1, 2, 4]), [1, 1, 1])
np.linalg.solve([[4, -2, 1], [-2, 4, -2], [1, -2, 4]], [11, -16, 17])
la.solve([[2]], [4])
from numpy.linalg import solve, inv, norm; norm([3, 4]), inv([[2.0]])
import numpy.linalg as linear; linear.det([[1, 2], [3, 4]])
np.linalg.inv([[1, 2], [3, 4]])
np.linalg.inv(np.eye(3) * 2)
np.linalg.inv([[0, 2], [1, 0]])
np.linalg.inv([[4, 7, 2], [3, 6, 1], [2, 5, 3]])
np.linalg.det([[1, 2], [3, 4]]), np.linalg.det([[2]]), np.linalg.det([[1, 2], [2, 4]]), np.linalg.det(np.eye(4)), np.linalg.det([[0, 1], [1, 0]])
np.linalg.det([[4, 7, 2], [3, 6, 1], [2, 5, 3]])
np.linalg.slogdet([[1, 2], [3, 4]])[0] + 0, np.linalg.slogdet([[1, 2], [3, 4]])[1] + 0
np.linalg.norm([3, 4]), np.linalg.norm([1, 2, 3]), np.linalg.norm([[1, 2], [3, 4]]), np.linalg.norm(5), np.linalg.norm([])
np.linalg.norm([1, -2, 3], 1), np.linalg.norm([1, -2, 3], 2), np.linalg.norm([1, -2, 3], np.inf), np.linalg.norm([1, -2, 3], -np.inf), np.linalg.norm([1, 0, 3], 0), np.linalg.norm([1, 2], 3)
np.linalg.norm([[1, -2], [3, 4]], 1), np.linalg.norm([[1, -2], [3, 4]], np.inf), np.linalg.norm([[1, 2], [3, 4]], 2), np.linalg.norm([[1, 2], [3, 4]], "fro"), np.linalg.norm([[1, 2], [3, 4]], "nuc"), np.linalg.norm([[1, 2], [3, 4]], -2)
np.linalg.norm([[1, -2], [3, 4]], -1), np.linalg.norm([[1, -2], [3, 4]], -np.inf)
np.linalg.norm([[1, 2], [3, 4]], axis=0), np.linalg.norm([[1, 2], [3, 4]], axis=1), np.linalg.norm([[3, 4], [6, 8]], axis=-1)
np.linalg.norm([[1, -2], [3, 4]], 1, axis=0), np.linalg.norm([[1, -2], [3, 4]], np.inf, axis=1), np.linalg.norm([[3, 4], [6, 8]], axis=1, keepdims=True)
np.linalg.norm([[1, 2], [3, 4]], axis=(0, 1)), np.linalg.norm([[1, 2], [3, 4]], ord=1, axis=(0, 1)), np.linalg.norm([3, 4], keepdims=True)
np.linalg.norm(np.array([1, 2, 3]) - np.array([4, 5, 6]))
np.linalg.pinv([[1, 2], [3, 4], [5, 6]])
np.linalg.pinv([[1, 2], [2, 4]])
np.linalg.pinv([[1.0, 2, 3]])
np.linalg.pinv(np.zeros((2, 3)))
np.linalg.lstsq([[1, 1], [1, 2], [1, 3]], [1, 2, 2.5], rcond=None)[0]
np.linalg.lstsq([[1, 1], [1, 2], [1, 3]], [1, 2, 2.5], rcond=None)[1]
np.linalg.lstsq([[1, 1], [1, 2], [1, 3]], [1, 2, 2.5])[3]
len(np.linalg.lstsq([[1, 1], [1, 2], [1, 3]], [1, 2, 2.5]))
int(np.linalg.lstsq([[1, 1], [1, 2], [1, 3]], [1, 2, 2.5])[2])
np.linalg.lstsq([[1, 2], [2, 4], [3, 6]], [1, 2, 3], rcond=None)[0]
np.linalg.lstsq([[1, 2, 3]], [6], rcond=None)[0]
np.linalg.lstsq([[1, 1], [1, 2], [1, 3]], [[1, 2], [2, 3], [2.5, 5]], rcond=None)[0]
np.linalg.matrix_rank([[1, 2], [2, 4]]) + 0, np.linalg.matrix_rank(np.eye(3)) + 0, np.linalg.matrix_rank(np.zeros((2, 2))) + 0, np.linalg.matrix_rank([1, 0]) + 0
np.linalg.matrix_rank([[1, 2, 3], [4, 5, 6], [7, 8, 9]]) + 0
np.linalg.matrix_power([[1, 1], [0, 1]], 5), np.linalg.matrix_power([[1, 1], [0, 1]], 0), np.linalg.matrix_power([[2.0, 0], [0, 4]], -1)
np.linalg.cond([[1, 2], [3, 4]]), np.linalg.cond(np.eye(2)), np.linalg.cond([[1, 2], [3, 4]], 1), np.linalg.cond([[1, 2], [3, 4]], np.inf)
np.linalg.svd([[1, 2], [3, 4], [5, 6]], compute_uv=False)
np.linalg.svd([[3.0, 0], [0, -2]])[1]
u, s, v = np.linalg.svd([[1, 2], [3, 4], [5, 6]]); u.shape, s.shape, v.shape
u, s, v = np.linalg.svd([[1, 2], [3, 4], [5, 6]], full_matrices=False); (u * s) @ v
u, s, v = np.linalg.svd([[1, 2, 3], [4, 5, 6]], full_matrices=False); (u * s) @ v
u, s, v = np.linalg.svd([[1, 2, 3], [4, 5, 6]]); u @ u.T, v @ v.T
u, s, v = np.linalg.svd([[1, 2], [2, 4], [3, 6]]); u @ u.T, v @ v.T, s
u, s, v = np.linalg.svd(np.zeros((2, 2))); u @ u.T, v @ v.T, s
np.linalg.qr([[1, 2], [3, 4]])[0], np.linalg.qr([[1, 2], [3, 4]])[1]
np.linalg.qr([[1.0, 2], [3, 4], [5, 6]])[0], np.linalg.qr([[1.0, 2], [3, 4], [5, 6]])[1]
np.linalg.qr([[1.0, 2, 3], [4, 5, 6]])[1], np.linalg.qr([[1, 2], [3, 4]], mode="r")
np.linalg.qr([[1, 2], [3, 4], [5, 7]], mode="complete")[0].shape
np.linalg.cholesky([[4, 2], [2, 3]])
np.linalg.eigvalsh([[2, 1], [1, 2]]), np.linalg.eigvalsh([[4, 1, 0], [1, 3, 1], [0, 1, 2]])
w, v = np.linalg.eigh([[4, 1, 0], [1, 3, 1], [0, 1, 2]]); w, v @ np.diag(w) @ v.T
w, v = np.linalg.eigh(np.diag([3.0, 1])); w, abs(v)
a = np.array([[4, 7], [2, 6]]); np.linalg.inv(a) @ a
a = np.array([[4.0, 7], [2, 6]]); x = np.linalg.solve(a, [1, 2]); a @ x
# Jacobians and rotations as students write them
t = np.deg2rad(30); np.array([[np.cos(t), -np.sin(t)], [np.sin(t), np.cos(t)]]) @ np.array([1, 0])
q = [0.3, 0.5]; J = np.array([[-np.sin(q[0]) - np.sin(q[0] + q[1]), -np.sin(q[0] + q[1])], [np.cos(q[0]) + np.cos(q[0] + q[1]), np.cos(q[0] + q[1])]]); np.linalg.solve(J, [0.1, 0.2])
J = np.array([[1.0, 2, 3], [4, 5, 6]]); J.T @ np.linalg.inv(J @ J.T + 0.01 * np.eye(2)) @ [1, 2]
J = np.array([[1.0, 2, 3], [4, 5, 6]]); np.linalg.pinv(J) @ [1, 2]
w = [1, 2, 3]; np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
v = np.array([3.0, 4]); v / np.linalg.norm(v)
isinstance(np.linalg.LinAlgError(), ValueError)
