; [flow-number] 2:1: error: a vacant value is no number of a block or subprogram (hint: it is a whole number from 0 to 99999999)
GOTO #0
