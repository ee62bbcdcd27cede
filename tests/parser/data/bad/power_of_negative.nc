; [function-domain] 2:8: error: -8 ** 0.5 has no real value (hint: a negative base needs a whole exponent, zero one that is not negative)
G0 X[-8**0.5]
