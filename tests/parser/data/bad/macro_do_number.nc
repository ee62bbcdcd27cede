; [out-of-range] 2:19: error: DO and END take a number from 1 to 3 (hint: write DO1 and END1)
WHILE [#1 LT 5] DO4
