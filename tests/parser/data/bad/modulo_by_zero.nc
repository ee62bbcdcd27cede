; [division-by-zero] 2:8: error: 3 MOD zero (hint: check the divisor before MOD)
G0 X[3 MOD 0]
