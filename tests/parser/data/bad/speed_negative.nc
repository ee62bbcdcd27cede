; [value-negative] 2:1: error: S-100 is negative (hint: give the direction by M3 or M4 and a speed that is not negative)
S-100 M3
