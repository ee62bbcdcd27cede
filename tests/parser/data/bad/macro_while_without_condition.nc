; [value-missing] 2:7: error: WHILE has no condition (hint: write it in brackets: WHILE [#1 LT 5])
WHILE #1 LT 5 DO1
