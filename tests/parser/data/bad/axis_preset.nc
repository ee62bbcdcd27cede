; 2:1: error: G92 is not simulated (hint: use a work offset, G54 to G59)
G92 X0
