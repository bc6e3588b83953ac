# one line, so that each instruction of the loop is of line 2
while True: pass
