; [dwell-time] 2:1: error: G4 without a time (hint: give P in milliseconds, or X in seconds)
G4
