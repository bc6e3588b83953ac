# exceptions: the type, and numpy's sentence where a student reads it
np.array([1, 2, 3]) + np.array([1, 2])  # sentence
np.array([[1, 2]]) + np.ones((3, 3))  # sentence
np.array([1, 2, 3]) == np.array([1, 2])
np.array([1, 2, 3]) @ np.array([1, 2])  # sentence
np.ones((2, 3)) @ np.ones((2, 3))  # sentence
np.ones((2, 3)) @ np.ones(2)  # sentence
np.array([1, 2]) @ 2  # sentence
2 @ np.array([1, 2])  # sentence
np.dot(np.ones((2, 3)), np.ones((2, 3)))  # sentence
np.dot([1, 2], [1, 2, 3])  # sentence
np.array([1, 2])[2]  # sentence
np.array([1, 2])[-3]  # sentence
np.eye(2)[2]  # sentence
np.eye(2)[0, 2]  # sentence
np.eye(2)[0, -3]  # sentence
np.eye(2)[0, 0, 0]  # sentence
np.array([1, 2])[0, 0]  # sentence
np.array([1, 2])[:, 0]  # sentence
np.array([1, 2])[1.0]  # sentence
np.array([1, 2])["x"]  # sentence
np.array([1, 2])[[5]]  # sentence
np.array([1, 2])[[0.5]]  # sentence
np.array([1, 2])[[True]]  # sentence
np.eye(2)[np.zeros((2, 2))]  # sentence
np.eye(2)[[True, False, True]]  # sentence
np.eye(3)[[0, 1], [0, 1, 2]]  # sentence
np.array([1, 2])[..., ...]  # sentence
np.array([1, 2])[::0]  # sentence
np.array([1, 2])["a":]
a = np.zeros(2); a[5] = 1; a  # sentence
a = np.zeros(2); a[0] = [1, 2]; a  # sentence
a = np.zeros(2); a[:] = [1, 2, 3]; a  # sentence
a = np.zeros((2, 2)); a[0] = [1, 2, 3]; a  # sentence
a = np.zeros((2, 2)); a[:] = np.ones((3, 2)); a  # sentence
a = np.zeros(2); a[[0, 1]] = [1, 2, 3]; a
a = np.zeros(2); a[[True, False]] = [1, 2, 3]; a
a = np.zeros(2); a[0] = "x"; a
a = np.zeros(2, dtype=int); a[0] = np.nan; a  # sentence
a = np.zeros(2, dtype=int); a[0] = np.inf; a  # sentence
a = np.zeros(2); del a[0]; a
a = np.array([1, 2]); a += 1.5; a  # sentence
a = np.array([1, 2]); a /= 2; a  # sentence
a = np.array([True]); a += 1; a  # sentence
a = np.zeros(2); a += [1, 2, 3]; a
a = np.zeros(2); a += np.ones((3, 2)); a  # sentence
a = np.zeros(2, dtype=int); np.sin([1, 2], out=a); a  # sentence
np.array([[1, 2], [3]])  # sentence
np.array([1, [2, 3]])  # sentence
np.array([[1, 2], 3])  # sentence
np.array([[], [1]])  # sentence
np.array([[1, 2], [3, 4, 5]])  # sentence
if_array = np.array([1, 2]); 1 if if_array > 1 else 2  # sentence
bool(np.array([1, 2]))  # sentence
bool(np.array([]))  # sentence
0 < np.array([1, 2]) < 3  # sentence
np.array([1, 2]) > 1 and np.array([1, 2]) < 3  # sentence
not np.array([1, 2])  # sentence
while_array = np.array([1, 2]); [x for x in [1] if while_array == 1]  # sentence
float(np.array([1, 2]))
int(np.array([1, 2]))
range(np.array([1, 2]))
max(np.eye(2))  # sentence
np.array([1, 2]).item()  # sentence
np.array([1, 2, 3]).reshape(2, 2)  # sentence
np.arange(6).reshape(4, -1)  # sentence
np.arange(6).reshape(-1, -1)  # sentence
np.zeros(-1)  # sentence
np.zeros((2, -1))  # sentence
np.zeros("a")
np.zeros(2.5)
np.zeros()
np.ones(2, 3)
np.full((2, 2), [1, 2, 3])  # sentence
np.array()
np.array([1, 2], 3)
np.array([1, 2], dtype="x")
np.array([1, 2], foo=3)
np.arange()
np.arange(0, 1, 0)
np.linspace(0, 1, -1)  # sentence
np.concatenate([np.ones(2), np.ones((2, 2))])  # sentence
np.concatenate([np.ones((2, 2)), np.ones((2, 3))])  # sentence
np.concatenate([])  # sentence
np.concatenate([1, 2])  # sentence
np.concatenate(np.ones(2), np.ones(2))
np.vstack([[1, 2], [3]])  # sentence
np.hstack([np.ones((2, 2)), np.ones(2)])  # sentence
np.stack([[1, 2], [3]])  # sentence
np.stack([])  # sentence
np.append([[1, 2]], [3], axis=0)  # sentence
np.sum([1, 2], axis=1)  # sentence
np.sum([[1, 2]], axis=2)  # sentence
np.sum([[1, 2]], axis=-3)  # sentence
np.sum([1, 2], foo=1)
np.max([])  # sentence
np.min([])  # sentence
np.argmax([])  # sentence
np.max([1, 2], 5)  # sentence
max([], default=0) + np.max(np.zeros((0, 2)))  # sentence
np.sin()
np.sin("x")
np.sin([1, "x"])
np.sin(1, 2, 3, 4)
np.array([1, 2]) + "x"
np.array([1, 2]) + None
"x" + np.array([1, 2])
np.array([1, 2]) < None
np.array([1, 2]) < "x"
np.array([1, 2]) - {1: 2}
np.array([True]) - np.array([True])  # sentence
-np.array([True])  # sentence
np.sign([True])
~np.array([1.5])  # sentence
np.array([1.5]) & np.array([1.0])  # sentence
np.array([1.5]) << 1  # sentence
np.array([2, 3]) ** -1  # sentence
np.power(2, -1)  # sentence
np.where([True], 1)  # sentence
np.where([True, False], [1, 2, 3], [1, 2, 3])  # sentence
np.cross([1, 2, 3, 4], [1, 2, 3, 4])  # sentence
np.trace([1, 2])  # sentence
np.diag(3)  # sentence
np.interp(1, [1, 2], [1])  # sentence
np.interp(1, [1, 2], [1, 2], period=0)  # sentence
np.diff([1, 2], prepend=[[1]])  # sentence
np.diff(3)  # sentence
np.diff([1, 2], -1)  # sentence
np.repeat([1, 2], -1)
np.transpose([[1, 2]], (0, 0))  # sentence
np.transpose([[1, 2]], (0,))  # sentence
np.squeeze([[1, 2]], axis=1)  # sentence
np.broadcast_to([1, 2], (3,))
np.percentile([1, 2], 101)  # sentence
np.linalg.solve([[1, 2], [2, 4]], [1, 2])  # sentence
np.linalg.solve([[1, 2, 3], [4, 5, 6]], [1, 2])  # sentence
np.linalg.solve([[1, 2], [3, 4]], [1, 2, 3])  # sentence
np.linalg.solve([1, 2], [1, 2])  # sentence
np.linalg.solve([[1, 2], [3, 4]], np.ones((3, 2)))  # sentence
np.linalg.inv([[1, 2], [2, 4]])  # sentence
np.linalg.inv(np.zeros((2, 2)))  # sentence
np.linalg.inv([[1, 2, 3]])  # sentence
np.linalg.inv([1, 2])  # sentence
np.linalg.inv(3)  # sentence
np.linalg.det([[1, 2, 3]])  # sentence
np.linalg.cholesky([[1, 2], [2, 1]])  # sentence
np.linalg.norm([1, 2], "fro")  # sentence
np.linalg.norm([[1, 2]], 3)  # sentence
np.linalg.norm([1, 2], axis=1)  # sentence
np.linalg.matrix_power([[1, 2]], 2)  # sentence
np.linalg.matrix_power([[1, 2], [3, 4]], 1.5)  # sentence
np.linalg.lstsq([[1, 2]], [1, 2])  # sentence
np.linalg.svd([1, 2])  # sentence
np.arctn
np.linalg.solv
hash(np.array([1]))
np.array([1, 2])()
np.array([1, 2]).foo
len(np.array([1, 2])[0])
np.array([1, 2]).shape[1]
np.array([1, 2]).T[0, 0]  # sentence
x, y, z = np.array([1, 2]); x
x, y = np.array([1, 2, 3]); x
next(np.array([1, 2]))
| try:
|     np.linalg.inv(np.zeros((2, 2)))
| except np.linalg.LinAlgError as error:
|     found = str(error)
found
| try:
|     np.linalg.inv(np.zeros((2, 2)))
| except ValueError:
|     found = 1
found
| try:
|     np.sum([1], axis=3)
| except np.exceptions.AxisError:
|     found = 1
found
f"{np.array([1.5]):.2f}"
a = np.arange(3); a[a > 0] = [1, 2, 3]; a  # sentence
a = np.arange(3); a[a > 0] = [[1, 2]]; a  # sentence
a = np.arange(4).reshape(2, 2); a[a > 0] = [1, 2]; a  # sentence
np.ptp([True, False])  # sentence
a = np.array([1, 2]); a += [0.5, 1, 2]; a  # sentence
a = np.array([1, 2]); a[0] = [1, 2]; a  # sentence
np.cross([True, False, True], [True, True, True])  # sentence
np.eye(2)[[0, 5], 2:]  # sentence
np.maximum.reduce([])  # sentence
np.add.reduce([1], axis=1)  # sentence
np.sin.foo
