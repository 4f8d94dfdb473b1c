Include "_self.geo";
