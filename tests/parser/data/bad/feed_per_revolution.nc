; 2:1: error: G95 is not simulated (hint: give the feed per minute with G94)
G95
