; [keyword-missing] 2:16: error: WHILE has no DO (hint: write WHILE [#1 LT 5] DO1)
WHILE [#1 LT 5]
