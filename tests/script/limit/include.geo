Include "_self.geo"; // expect error: files include one another too deeply (the limit is 50); does '_self.geo' include itself?
