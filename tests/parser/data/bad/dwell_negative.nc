; [value-negative] 2:4: error: P-5 is negative (hint: a dwell takes a time that is not negative)
G4 P-5
