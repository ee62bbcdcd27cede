; [dwell-time] 2:7: error: G4 has both P and X (hint: give one time)
G4 P5 X1
