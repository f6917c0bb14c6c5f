# Links within a page, and out of this folder, become plain text: Doxygen 1.9.4 finds neither.
s,\[\([^]]*\)\](#[^)]*),\1,g
s,\[\([^]]*\)\](\.\./[^)]*),\1,g
