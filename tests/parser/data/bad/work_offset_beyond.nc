; 2:1: error: G54.1 is not simulated (hint: use G54 to G59)
G54.1 P3
