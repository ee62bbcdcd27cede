; [statement-not-alone] 2:8: error: words beside a statement (hint: write two blocks)
GOTO 5 G0 X1
