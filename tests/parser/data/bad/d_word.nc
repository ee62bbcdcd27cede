; 2:4: error: D1 has no meaning in this block (hint: cutter radius compensation is not simulated; leave D out)
T1 D1 M6
