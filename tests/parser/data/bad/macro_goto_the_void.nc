; [missing-label] 2:1: error: there is no N77 to go to (hint: the jump names a block or label of this program)
GOTO 77
