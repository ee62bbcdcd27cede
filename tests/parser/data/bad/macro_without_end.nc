; [flow-unpaired] 2:1: error: loop 1 has no end (hint: close it with its end)
WHILE [#1 LT 5] DO1
