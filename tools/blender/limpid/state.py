"""What the panel shows, and nothing of which is in the .blend: the job that runs, and what came of the last."""


class State:
    started = None   # begin.Started
    page = None      # view.Page
    failure = ""     # one sentence
    said = ()        # notes and warnings

    def tell(self, failure="", said=()):
        self.failure, self.said = failure, tuple(said)


state = State()
