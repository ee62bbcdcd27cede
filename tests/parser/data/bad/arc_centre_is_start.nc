; [arc-centre-is-start] 3:8: error: the centre of the arc is its start (hint: I and J lead from the start to the centre)
G0 X0 Y0
G2 X10 I0 J0 F100
