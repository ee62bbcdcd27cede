; [word-twice] 2:4: error: two O words in a block (hint: start a line for each)
O1 O2
