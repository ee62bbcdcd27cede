; [value-negative] 2:7: error: F-100 is negative (hint: give a feed above zero)
G1 X5 F-100
