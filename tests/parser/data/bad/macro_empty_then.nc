; [value-missing] 2:17: error: THEN does nothing (hint: write a setting after it: THEN #1=2)
IF [1 EQ 1] THEN
