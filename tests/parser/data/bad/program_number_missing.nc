; [name-missing] 2:3: error: O has no number (hint: write O and the number of the program, for example O1000)
O (main)
