# square brackets
np.array([1, 2, 3])[0]
np.array([1.5, 2])[1]
np.array([1, 2, 3])[-1]
np.array([True, False])[1]
np.array([[1, 2], [3, 4]])[0]
np.array([[1, 2], [3, 4]])[-1]
np.array([[1, 2], [3, 4]])[1, 0]
np.array([[1, 2], [3, 4]])[1][0]
np.array([[1, 2], [3, 4]])[-1, -1]
np.array([[1, 2], [3, 4]])[:, 0]
np.array([[1, 2], [3, 4]])[0, :]
np.array([[1, 2], [3, 4]])[:, 0:1]
np.array([[1, 2], [3, 4]])[:]
np.array([[1, 2], [3, 4]])[...]
np.array([[1, 2], [3, 4]])[..., 0]
np.array([[1, 2], [3, 4]])[0, ...]
np.array([[1, 2], [3, 4]])[:, ::-1]
np.array([[1, 2], [3, 4]])[::-1]
np.array([[1, 2], [3, 4]])[::-1, ::-1]
np.array([[1, 2], [3, 4]])[:, -1]
np.arange(10)[2:5]
np.arange(10)[:3]
np.arange(10)[7:]
np.arange(10)[-3:]
np.arange(10)[:-3]
np.arange(10)[::2]
np.arange(10)[1::3]
np.arange(10)[::-1]
np.arange(10)[8:2:-2]
np.arange(10)[-1:-4:-1]
np.arange(10)[5:2]
np.arange(10)[20:]
np.arange(10)[-20:3]
np.arange(10)[:20]
np.arange(10)[2:8][1:3]
np.arange(10)[::2][::-1]
np.arange(12).reshape(3, 4)[1:3, :2]
np.arange(12).reshape(3, 4)[::2, 1::2]
np.arange(12).reshape(3, 4)[1]
np.arange(12).reshape(3, 4)[1:2]
np.arange(12).reshape(3, 4)[2, 1:]
np.arange(12).reshape(3, 4)[5:]
np.arange(12).reshape(3, 4).T[1]
np.arange(12).reshape(3, 4).T[1:3, 0]
np.arange(3)[None]
np.arange(3)[None, :]
np.arange(3)[:, None]
np.arange(3)[:, np.newaxis]
np.arange(3)[np.newaxis]
np.arange(3)[1:, None]
np.arange(3)[None][0]
np.array([5])[None, 0]
np.array([5, 6])[0, None]
np.arange(3)[()]
np.eye(2)[()]
# masks and lists
a = np.arange(5); a[a > 2]
a = np.arange(5); a[a > 10]
a = np.arange(5); a[[True, False, True, False, False]]
a = np.arange(5.0); a[~(a > 2)]
a = np.arange(5); a[(a > 1) & (a < 4)]
a = np.arange(5); a[[0, 2]]
a = np.arange(5); a[[-1, 0, 0]]
a = np.arange(5); a[np.array([1, 3])]
a = np.arange(5); a[[]]
a = np.arange(5); a[np.array([[0, 1], [2, 3]])]
a = np.arange(5); a[[[0, 1], [2, 3]]]
a = np.arange(5); a[range(2)]
a = np.arange(6).reshape(2, 3); a[a > 2]
a = np.arange(6).reshape(2, 3); a[[1, 0]]
a = np.arange(6).reshape(2, 3); a[[True, False]]
a = np.arange(6).reshape(2, 3); a[:, [0, 2]]
a = np.arange(6).reshape(2, 3); a[:, [True, False, True]]
a = np.arange(6).reshape(2, 3); a[0, [0, 2]]
a = np.arange(6).reshape(2, 3); a[[0, 1], [1, 2]]
a = np.arange(6).reshape(2, 3); a[[0, 1], 2]
a = np.arange(6).reshape(2, 3); a[[1], :]
a = np.arange(6).reshape(2, 3); a[[0, 1], 1:]
a = np.arange(6).reshape(2, 3); a[1:, [0, 1]]
a = np.arange(6).reshape(2, 3); a[[[0], [1]], [0, 2]]
a = np.arange(6).reshape(2, 3); a[:, 0][a[:, 1] > 1]
a = np.arange(6).reshape(2, 3); a[a[:, 0] > 1]
a = np.arange(6).reshape(2, 3); a[a[:, 0] > 1, 1]
a = np.arange(6).reshape(2, 3); a[np.array([0, 1]), np.array([0, 0])]
a = np.arange(6).reshape(2, 3); a[..., [0, 1]]
a = np.arange(5); a[np.where(a > 2)]
a = np.arange(6).reshape(2, 3); a[np.where(a > 2)]
a = np.array([3, 1, 2]); a[np.argsort(a)]
a = np.array([3, 1, 2]); a[a.argmax()]
# assignment
a = np.zeros(3); a[0] = 5; a
a = np.zeros(3); a[-1] = 5; a
a = np.zeros(3); a[1:] = 5; a
a = np.zeros(3); a[1:] = [5, 6]; a
a = np.zeros(3); a[:] = 2; a
a = np.zeros(3); a[::2] = [1, 2]; a
a = np.zeros(3); a[::-1] = [1, 2, 3]; a
a = np.zeros(3); a[...] = 4; a
a = np.zeros((2, 2)); a[0] = 5; a
a = np.zeros((2, 2)); a[0] = [1, 2]; a
a = np.zeros((2, 2)); a[0, 1] = 5; a
a = np.zeros((2, 2)); a[0][1] = 5; a
a = np.zeros((2, 2)); a[:, 0] = [1, 2]; a
a = np.zeros((2, 2)); a[:, 0] = 3; a
a = np.zeros((2, 2)); a[:] = [1, 2]; a
a = np.zeros((2, 2)); a[:] = [[1], [2]]; a
a = np.zeros((2, 3)); a[:, 1:] = np.eye(2); a
a = np.zeros((2, 2)); a[:, :1] = [[1], [2]]; a
a = np.zeros(3); a[:] = [[1, 2, 3]]; a
a = np.zeros(3, dtype=int); a[0] = 2.7; a
a = np.zeros(3, dtype=int); a[0] = -2.7; a
a = np.zeros(3, dtype=int); a[:] = [0.5, 1.5, 2.5]; a
a = np.array([1, 2, 3]); a[1] = 3.99; a
a = np.array([1, 2, 3]); a[1] = True; a
a = np.zeros(3, dtype=bool); a[0] = 5; a
a = np.arange(5); a[a > 2] = 0; a
a = np.arange(5); a[a > 2] = [7, 8]; a
a = np.arange(5); a[[0, 2]] = 9; a
a = np.arange(5); a[[0, 2]] = [8, 9]; a
a = np.arange(5); a[[0, 0]] += 1; a
a = np.arange(6).reshape(2, 3); a[a > 2] = -1; a
a = np.arange(6).reshape(2, 3); a[:, [0, 2]] = 0; a
a = np.arange(6).reshape(2, 3); a[[0, 1], [0, 1]] = 9; a
a = np.arange(6).reshape(2, 3); a[a[:, 0] > 1] = 0; a
a = np.arange(5.0); a[np.isnan(a)] = 0; a
a = np.zeros((2, 2)); a[np.eye(2) > 0] = [1, 2]; a
a = np.zeros(4); a[1:3] = np.array([1, 2]) * 2.5; a
a = np.arange(5); a[1:] = a[:-1]; a
a = np.arange(5); a[:-1] = a[1:]; a
a = np.arange(4).reshape(2, 2); a[:] = a.T; a
# views
a = np.arange(5); b = a[1:3]; b[0] = 99; a
a = np.arange(5); b = a[1:3]; a[1] = 99; b
a = np.arange(5); b = a[::2]; b[:] = 0; a
a = np.arange(6).reshape(2, 3); b = a[0]; b[0] = 9; a
a = np.arange(6).reshape(2, 3); b = a[:, 1]; b[:] = 9; a
a = np.arange(6).reshape(2, 3); b = a.T; b[0, 1] = 9; a
a = np.arange(6); b = a.reshape(2, 3); b[0, 0] = 9; a
a = np.arange(6).reshape(2, 3); b = a.ravel(); b[0] = 9; a
a = np.arange(6).reshape(2, 3); b = a.flatten(); b[0] = 9; a
a = np.arange(6).reshape(2, 3); b = a.T.ravel(); b[0] = 9; a
a = np.arange(6).reshape(2, 3).T; b = a.reshape(6); b[0] = 9; a
a = np.arange(5); b = a.copy(); b[0] = 9; a
a = np.arange(5); b = a[a > 1]; b[0] = 9; a
a = np.arange(5); b = a[[0, 1]]; b[0] = 9; a
a = np.arange(5); b = a[:]; b[0] = 9; a
a = np.arange(3); b = a[:, None]; b[0, 0] = 9; a
a = np.zeros((2, 2)); r = [row for row in a]; r[0][:] = 7; a
| a = np.zeros((2, 2))
| for row in a:
|     row += 1
a
| a = np.zeros(3)
| for i in range(3):
|     a[i] = i ** 2
a
| a = np.zeros((2, 3))
| for i in range(2):
|     for j in range(3):
|         a[i, j] = 10 * i + j
a
a = np.arange(5)[::-1]; a[0] = 7; a.reshape(5, 1)
a = np.arange(6).reshape(2, 3)[:, ::-1]; a.reshape(3, 2)
a = np.arange(6).reshape(2, 3)[:, 1]; a.reshape(2, 1)
a = np.arange(6).reshape(6, 1)[::2]; a.reshape(3)
# iteration, length, membership
list(np.array([1, 2]))
[x * 2 for x in np.array([1.5, 2])]
len(np.array([1, 2, 3])), len(np.zeros((2, 5)))
[r.sum() for r in np.eye(2)]
x, y = np.array([1, 2]); (y, x)
(x, y), z = [np.array([1, 2]), 3]; y
2 in np.array([1, 2]), 5 in np.array([1, 2])
1.0 in np.eye(2)
list(zip(np.array([1, 2]), [3, 4]))
list(enumerate(np.array([5, 6])))
sorted(np.array([3, 1, 2]))
max(np.array([3, 1, 2])), min(np.array([3, 1, 2])), sum(np.array([3, 1, 2]))
list(reversed(np.array([1, 2, 3])))
list(map(float, np.array([1, 2])))
tuple(np.array([1, 2]))
np.arange(6).reshape(2, 3).tolist()
np.array([1.5, 2]).tolist(), np.array([True]).tolist()
np.array([7]).item(), np.array([1, 2]).item(1), np.eye(2).item(0, 1), np.eye(2).item(3)
bool(np.array([1])), bool(np.array([0.0])), bool(np.array([[True]]))
any(np.array([0, 1])), all(np.array([1, 1]))
a = np.arange(4.0); a.fill(3); a
np.arange(6).reshape(2, 3).flat[4]
list(np.arange(4).reshape(2, 2).flat)
*a, b = np.arange(3); b
np.take([4, 5, 6], [0, 2])
np.take(np.arange(6).reshape(2, 3), [0, 2], axis=1)
np.delete([1, 2, 3], 1)
np.delete(np.arange(6).reshape(2, 3), 0, axis=0)
np.delete([1, 2, 3], [0, -1])
np.arange(5)[::10 ** 18], np.arange(5)[3::-10 ** 18], np.eye(2)[::10 ** 18, 1:10 ** 30]
