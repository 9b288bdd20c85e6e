namespace abut {}
