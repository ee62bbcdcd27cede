; [unexpected-character] 2:6: error: unexpected '+' between words (hint: put expressions in [ ] after a letter: X[1+2])
G0 X1+2
