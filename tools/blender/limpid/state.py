"""State of the panel outside of the .blend: the running job, and the result of the last job."""


class State:
    started = None   # begin.Started
    page = None      # view.Page
    failure = ""     # one sentence
    said = ()        # notes and warnings

    def tell(self, failure="", said=()):
        self.failure, self.said = failure, tuple(said)


state = State()
