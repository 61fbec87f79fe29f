// Pages without pictures and live plots.

startTheme();
startTables();
