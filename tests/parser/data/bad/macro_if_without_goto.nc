; [keyword-missing] 2:13: error: IF has neither GOTO nor THEN (hint: write IF [c] GOTO 100 or IF [c] THEN #1=2)
IF [1 EQ 1] GO 5
