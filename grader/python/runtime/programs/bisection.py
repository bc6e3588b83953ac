from bisect import *
print(bisect_left([1,2,2,3], 2), bisect_right([1,2,2,3], 2), bisect([1,2], 5)); l = [1,3]; insort(l, 2); print(l)
