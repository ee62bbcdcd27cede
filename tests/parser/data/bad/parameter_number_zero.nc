; 2:5: error: parameter #0 does not exist (hint: parameters are #1 to #99999)
G0 X#0
