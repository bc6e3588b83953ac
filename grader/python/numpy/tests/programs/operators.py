# operators, promotion, broadcasting
np.array([1, 2]) / 2
np.array([1, 2]) + 1
np.array([1, 2]) + 1.5
np.array([1, 2]) - [3, 4]
[1, 2] + np.array([3, 4])
(1, 2) * np.array([3, 4])
[1, 2] * np.array([3, 4])
[3, 4] - np.array([1, 2])
[3, 4] / np.array([1, 2])
2 * np.array([1, 2])
2.0 * np.array([1, 2])
10 - np.array([1, 2])
1 / np.array([1.0, 2, 4])
np.array([7, -7]) // 2
np.array([7, -7]) // -2
np.array([7.5, -7.5]) // 2
np.array([7, -7]) % 3
np.array([7, -7]) % -3
np.array([7.5, -7.5]) % 2
np.array([7.5, -7.5]) % -2
7 // np.array([2, -2])
7 % np.array([2, -2])
7.5 % np.array([2.0, -2])
np.array([1, 2]) // 0
np.array([1, 2]) % 0
np.array([1.0, -1, 0]) / 0
np.array([1.0, -1, 0]) // 0
np.array([1.0, -1, 0]) % 0
np.array([1, 2]) / 0
divmod(np.array([7, -7]), 3)
divmod(7, np.array([2, -2]))
np.array([1, 2, 3]) ** 2
np.array([1, 2, 3]) ** 2.0
np.array([1.0, 2, 3]) ** 0.5
np.array([1.0, 2, 4]) ** -1
np.array([2, 3]) ** np.array([3, 2])
2 ** np.array([1, 2, 3])
2.0 ** np.array([1, 2, -3])
np.array([-8.0, 8]) ** (1 / 3)
np.array([2, 3]) ** 0
np.array([3]) ** 20
np.array([1.5, 2.5]) ** 3
-np.array([1, -2])
-np.array([0, 1])
+np.array([1.0, -2])
abs(np.array([1, -2]))
abs(np.array([-1.5, 2]))
~np.array([True, False])
~np.array([1, 2])
np.array([True, False]) & np.array([True, True])
np.array([True, False]) | np.array([False, False])
np.array([True, False]) ^ np.array([True, True])
np.array([6, 5]) & 3
np.array([6, 5]) | 8
np.array([6, 5]) ^ 1
np.array([1, 2]) << 2
np.array([8, -8]) >> 1
np.array([True, False]) + np.array([True, True])
np.array([True, False]) * np.array([True, True])
np.array([True, False]) + 1
np.array([True, False]) * 2.5
np.array([True, False]) / 2
np.array([True, True]) - 1
True + np.array([1, 2])
np.array([1, 2, 3]) < 2
np.array([1, 2, 3]) <= [3, 2, 1]
np.array([1, 2, 3]) == 2
np.array([1, 2, 3]) != np.array([1, 0, 3])
2 > np.array([1, 2, 3])
[1, 5] >= np.array([2, 2])
np.array([1, 2]) == None
np.array([1, 2]) != None
np.array([np.nan, 1]) == np.nan
np.array([np.nan, 1]) != np.nan
np.array([1.0, np.nan]) < 2
(np.array([1, 2, 3]) > 1) & (np.array([1, 2, 3]) < 3)
# broadcasting
np.array([[1], [2]]) * np.array([10, 20, 30])
np.array([[1, 2], [3, 4]]) + np.array([10, 20])
np.array([[1, 2], [3, 4]]) + np.array([[10], [20]])
np.array([[1, 2], [3, 4]]) * 2
np.array([1, 2]) + np.array([[1]])
np.array([[1, 2]]) + np.array([[1], [2]])
np.array([1]) + np.array([1, 2, 3])
np.ones((2, 3)) + np.ones(3)
np.ones((1, 3)) * np.ones((3, 1))
np.zeros((0, 3)) + 1
np.array([]) * 2
np.zeros((0, 3)) + np.ones(3)
np.eye(2) - [1, 2]
np.eye(2) - [[1], [2]]
# matrix products
np.array([1, 2]) @ np.array([3, 4])
np.array([1.5, 2]) @ [2, 2]
[1, 2] @ np.array([3, 4])
np.array([[1, 2], [3, 4]]) @ np.array([1, 1])
np.array([1, 1]) @ np.array([[1, 2], [3, 4]])
np.array([[1, 2], [3, 4]]) @ np.array([[0, 1], [1, 0]])
np.array([[1.0, 2, 3]]) @ np.array([[1], [2], [3]])
np.array([[1], [2]]) @ np.array([[3, 4]])
np.array([[1, 2], [3, 4]]) @ [1, 1]
np.eye(3) @ np.arange(3)
np.array([True, False]) @ np.array([True, True])
np.zeros((2, 0)) @ np.zeros((0, 3))
np.arange(6).reshape(2, 3) @ np.arange(6).reshape(2, 3).T
# in place
a = np.array([1.0, 2]); a += 1; a
a = np.array([1, 2]); a += 1; a
a = np.array([1, 2]); a *= 3; a
a = np.array([1.0, 2]); a /= 2; a
a = np.array([1.0, 2]); a -= [1, 1]; a
a = np.array([5, 7]); a //= 2; a
a = np.array([5, 7]); a %= 3; a
a = np.array([5, 7]); a **= 2; a
a = np.array([True, False]); a |= True; a
a = np.array([True, False]); a &= np.array([False, True]); a
a = np.array([1.0, 2]); b = a; b += 1; a
a = np.array([1.0, 2]); b = a; b = b + 1; a
a = np.zeros((2, 2)); a += [1, 2]; a
a = np.zeros((2, 2)); a[0] += 5; a
a = np.zeros((2, 2)); a[:, 1] += 5; a
a = np.zeros(3); a[1:] += 1; a
a = np.zeros(3); a[a == 0] += 2; a
a = np.arange(4); a[1:] += a[:-1]; a
a = np.eye(2); a @= np.array([[0.0, 1], [1, 0]]); a
a = np.array([1, 2]); a += True; a
a = [1, 2]; a += np.array([1, 1]); a
x = 1; x += np.array([1, 2]); x
x = 0.0; x = x + np.array([1.0, 2]); x
sum([np.array([1, 2]), np.array([3, 4])])
np.array([1, 2]) * np.float64(2)
np.float64(2) * np.array([1, 2])
np.array([0.1, 0.2]) + np.array([0.2, 0.1])
np.array([1e308]) * 10
np.array([5.0]) - np.array([5.0])
np.array([1, 2]) + (np.array([1, 2]) > 1)
np.array([3, 4]) * np.array([0.5, 0.25]) + 1
np.array([-2 ** 63]) // -1 * 0, np.array([-2 ** 63]) % -1, np.array([7, 8]) // np.array([-2, -2])
