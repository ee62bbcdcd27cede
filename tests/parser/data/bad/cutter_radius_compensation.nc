; 2:1: error: G41 is not simulated (hint: program the path of the tool centre and use G40)
G41 D1
