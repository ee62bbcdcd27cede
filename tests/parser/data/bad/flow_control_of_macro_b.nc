; 2:1: error: I has no number (hint: give I a number, a parameter (#1) or an expression in [ ])
IF [#1 EQ 0] GOTO 10
