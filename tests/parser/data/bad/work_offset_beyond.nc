; [not-simulated] 2:1: error: G54.2 is not simulated (hint: use G54 to G59)
G54.2 P3
