; [letter-missing] 2:4: error: a number without a letter (hint: put a letter before it, for example X; a number has one decimal point and no blanks)
G0 5
