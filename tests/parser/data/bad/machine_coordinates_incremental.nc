; [machine-coordinates] 2:5: error: G53 in G91 (hint: machine coordinates need G90)
G91 G53 G0 X0
