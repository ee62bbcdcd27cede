; [not-simulated] 2:1: error: G43.1 is not simulated (hint: use G43 H, G43.4 H or G43.5 H)
G43.1 Z100
